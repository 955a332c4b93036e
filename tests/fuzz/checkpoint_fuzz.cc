// A checkpoint in the data folder of a server that starts again.
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/scenes.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  static const auto patches = std::make_shared<const PatchSet>(PatchesOf(MakeCornell(1)));
  static const Plan plan = [] {
    SolveOptions options;
    options.shoot.method = Method::kPhsAlpha;
    options.max_rays = 100'000;
    return MakePlan(*patches, options);
  }();
  Solver solver(patches, plan.options, [] { return 0.; });
  if (solver.Restore(bytes).ok()) EncodeSolution(*solver.MakeSnapshot().solution);
}

}  // namespace lambert
