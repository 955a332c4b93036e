// Adaptive meshing: patches are split where light varies inside them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/functional/function_ref.h"
#include "absl/status/statusor.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/mesh_error.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// A budget of PatchOptions::adapt_patches that suits most rooms.
inline constexpr int64_t kDefaultAdaptPatches = 50'000;

// What adaptive meshing did.
struct Meshing {
  int64_t coarse_patches = 0;   // before it
  int32_t pilots = 0;           // solutions that it was guided by
  int64_t pilot_rays = 0;       // of all of them
  double predicted_error = -1;  // of the patches as they are then, as MeshError::rms_area
  double seconds = 0;           // wall clock, where the caller keeps it
  std::string reason;           // why it ended: one sentence
};

// Adds to the plan of unsplit patches what is known of adaptive meshing before any pilot has run:
// nothing where it is off.
void AddMeshing(const PatchSet& coarse, const PatchOptions& options, Plan& plan);
// What is known of it afterwards: left out where it split nothing.
PlanItem TellMeshing(const Meshing& meshing, int64_t patches);

// Solves `patches` with `pilot` to the end of its budget.
using RunPilot = absl::FunctionRef<absl::StatusOr<Solution>(
    const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot, int32_t number)>;

// The scene's patches, split until the error that pilots predict is under the wanted one
// (solve.max_error), patches are options.adapt_patches, or no difference is left beyond noise: then
// those without any are the triangles as they were. Depends on scene, options and seed alone, as
// long as `run` does. At most sixteen pilots, which together shoot at most a quarter of solve's
// budget of rays, and about a quarter of what its time allows. `meshing`: what was done. Where
// `run` keeps its `seconds`, no pilot begins after a quarter of solve's time. Fails as BuildPatches
// does, and as `run` does.
absl::StatusOr<std::shared_ptr<const PatchSet>> AdaptMesh(const Scene& scene,
                                                          const PatchOptions& options,
                                                          const SolveOptions& solve, RunPilot run,
                                                          Meshing* meshing);

struct Splits {
  EdgeMarks marks;   // the edges to halve
  double share = 0;  // of the sum of MeshError::squares that the patches have which are split
};

// Splits the patches with the most of the error: those that have four fifths of it together, or
// fewer where they would become more than `most_patches`. Empty where none can be.
Splits ChooseSplits(const PatchSet& patches, const MeshError& error, int64_t most_patches);

}  // namespace lambert
