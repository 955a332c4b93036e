// coordinator_bench SQUARES...: what the model of docs/scaling.md needs of one coordinator, for
// rooms of 32 SQUARES^2 patches each, in one thread: processor time of a step a patch (allocate,
// cut, book), and of a result a byte, by part. A line a room.
#include <ctime>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

#include "radiosity/core/digest.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

double ProcessorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Runs units as they come and keeps its own time and the units' number apart.
class TimedExecutor : public StepExecutor {
 public:
  explicit TimedExecutor(std::shared_ptr<const Shooter> shooter) : serial_(std::move(shooter)) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    const double start = ProcessorSeconds();
    absl::StatusOr<UnitResult> result = serial_.RunStep(units);
    seconds += ProcessorSeconds() - start;
    ++steps;
    return result;
  }
  double seconds = 0;
  int64_t steps = 0;

 private:
  SerialExecutor serial_;
};

// Mean seconds of a call, over as many as fit into a fifth of a second.
double Mean(const std::function<void()>& call) {
  const double start = ProcessorSeconds();
  int calls = 0;
  for (; calls < 2 || ProcessorSeconds() - start < 0.2; ++calls) call();
  return (ProcessorSeconds() - start) / calls;
}

void Measure(int squares) {
  auto patches = std::make_shared<const PatchSet>(
      *BuildPatches(*LoadGltf({"room.glb", ToGlb(MakeCornell(squares)), {}}), {}));
  const auto count = static_cast<double>(patches->size());
  SolveOptions options;
  options.shoot.method = Method::kPmcr;
  options.max_rays = 100 * patches->size();
  const Plan plan = MakePlan(*patches, options);
  const auto shooter = *Shooter::Create(patches, plan.options.shoot);
  TimedExecutor executor(shooter);
  Solver solver(patches, plan.options, [] { return 0.0; });
  const double start = ProcessorSeconds();
  while (solver.stop_reason() == StopReason::kNone) {
    if (!solver.RunPass(executor, nullptr).ok()) return;
  }
  const double stepping = ProcessorSeconds() - start - executor.seconds;

  // A unit of four rays a patch, all patches alike.
  WorkUnit unit;
  for (PatchIndex i = 0; i < patches->size(); ++i) unit.visits.push_back({i, 4, 0, 4, {4, 4, 4}});
  const UnitResult result = *shooter->Run(unit);
  const std::string bytes = EncodeUnitResult(result);
  const auto size = static_cast<double>(bytes.size());
  UnitResult merged = result;
  const double hash = Mean([&] { Sha256Hex(bytes); });
  const double decode = Mean([&] { DecodeUnitResult(bytes, patches->size()).IgnoreError(); });
  const double check = Mean([&] { CheckLedger(unit, result).IgnoreError(); });
  const double merge = Mean([&] { MergeResult(result, merged); });
  std::printf(
      "%.0f patches: step %.1f ns a patch (%lld steps); result %.1f bytes a patch that was hit; a "
      "byte: hash %.2f, decode %.2f, check %.2f, merge %.2f ns\n",
      count, 1e9 * stepping / (static_cast<double>(executor.steps) * count),
      static_cast<long long>(executor.steps), size / static_cast<double>(result.deposits.size()),
      1e9 * hash / size, 1e9 * decode / size, 1e9 * check / size, 1e9 * merge / size);
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: coordinator_bench SQUARES...\n");
    return 2;
  }
  for (int i = 1; i < argc; ++i) lambert::Measure(std::atoi(argv[i]));
  return 0;
}
