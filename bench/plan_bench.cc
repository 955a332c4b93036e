// plan_bench SCENE.glb PART|all METHOD RAYS TURNS [MAX_EDGE]: what a part of the work costs where
// the plan leaves it out; `all`: each part that the plan leaves out and would do where it is asked
// to.
//
// Solves the scene with the part and without it, turn by turn, each time in a process of its own
// and in one thread, with every unit and result encoded and decoded as on the wire. Prints, for
// each side, the median over the turns of: CPU seconds in all, of shooting, of encoding and
// decoding, of merging; bytes of units and results; peak resident size; rays; error as estimated.
// Then the median of the turns' ratios, with over without.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"

namespace lambert {
namespace {

constexpr const char* kNames[] = {"CPU s",    "shoot s", "wire s", "merge s",   "unit B",
                                  "result B", "peak B",  "rays",   "estimated", "std_error"};
constexpr int kCount = std::size(kNames);
struct Numbers {
  double of[kCount] = {};
};

class WireExecutor : public StepExecutor {
 public:
  WireExecutor(std::shared_ptr<const Shooter> shooter, PatchIndex patches, Numbers& numbers)
      : shooter_(std::move(shooter)), patches_(patches), numbers_(numbers) {}

  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    UnitResult merged;
    for (const WorkUnit& unit : units) {
      double* n = numbers_.of;
      double start = ThreadCpuSeconds();
      const std::string bytes = EncodeUnit(unit);
      const absl::StatusOr<WorkUnit> arrived = DecodeUnit(bytes);
      n[2] += ThreadCpuSeconds() - start;
      const absl::StatusOr<UnitResult> result = shooter_->Run(*arrived);
      if (!result.ok()) return result.status();
      n[1] += result->cpu_seconds;
      start = ThreadCpuSeconds();
      const std::string result_bytes = EncodeUnitResult(*result);
      const absl::StatusOr<UnitResult> returned = DecodeUnitResult(result_bytes, patches_);
      n[2] += ThreadCpuSeconds() - start;
      start = ThreadCpuSeconds();
      if (absl::Status status = CheckLedger(unit, *returned); !status.ok()) return status;
      MergeResult(*returned, merged);
      n[3] += ThreadCpuSeconds() - start;
      n[4] += static_cast<double>(bytes.size());
      n[5] += static_cast<double>(result_bytes.size());
    }
    return merged;
  }

 private:
  const std::shared_ptr<const Shooter> shooter_;
  const PatchIndex patches_;
  Numbers& numbers_;
};

void Fail(const std::string& message) {
  std::fprintf(stderr, "%s\n", message.c_str());
  std::_Exit(1);
}

Numbers Solve(const std::shared_ptr<const PatchSet>& patches, const SolveOptions& options) {
  Numbers numbers;
  const double start = ThreadCpuSeconds();
  const Plan plan = MakePlan(*patches, options);
  auto shooter = Shooter::Create(patches, plan.options.shoot);
  if (!shooter.ok()) Fail(std::string(shooter.status().message()));
  WireExecutor executor(*shooter, patches->size(), numbers);
  Solver solver(patches, plan.options, [] { return 0.0; });
  while (solver.stop_reason() == StopReason::kNone) {
    const absl::Status status = solver.RunPass(executor, [](const Progress&) {});
    if (!status.ok()) Fail(std::string(status.message()));
  }
  const Snapshot snapshot = solver.MakeSnapshot();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  numbers.of[0] = ThreadCpuSeconds() - start;
  numbers.of[6] = 1024.0 * static_cast<double>(usage.ru_maxrss);
  numbers.of[7] = static_cast<double>(snapshot.progress.rays);
  numbers.of[8] = snapshot.progress.estimated_rms_area;
  for (const Rgb& error : snapshot.solution->std_error_lm_per_m2) numbers.of[9] += Mean(error);
  return numbers;
}

// In a process of its own, so that one run's memory is not another's.
Numbers SolveApart(const std::shared_ptr<const PatchSet>& patches, const SolveOptions& options) {
  int ends[2];
  if (pipe(ends) != 0) Fail("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    const Numbers numbers = Solve(patches, options);
    const bool sent = write(ends[1], &numbers, sizeof(numbers)) == sizeof(numbers);
    std::_Exit(sent ? 0 : 1);
  }
  close(ends[1]);
  Numbers numbers;
  const bool read_all = read(ends[0], &numbers, sizeof(numbers)) == sizeof(numbers);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  if (!read_all) Fail("a run failed");
  return numbers;
}

double Median(const std::vector<Numbers>& runs, const std::function<double(const Numbers&)>& of) {
  std::vector<double> values;
  for (const Numbers& run : runs) values.push_back(of(run));
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::shared_ptr<const PatchSet> Load(const char* path, double max_edge_m) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto scene = LoadGltf({"scene.glb", bytes, {}});
  if (!scene.ok()) Fail(std::string(scene.status().message()));
  PatchOptions options;
  options.max_edge_m = max_edge_m;
  auto patches = BuildPatches(*scene, options);
  if (!patches.ok()) Fail(std::string(patches.status().message()));
  return std::make_shared<const PatchSet>(*std::move(patches));
}

struct Case {
  std::shared_ptr<const PatchSet> patches;
  SolveOptions options;
  int turns = 1;
};

bool LeavesOut(const Plan& plan, Part part) {
  return std::any_of(plan.items.begin(), plan.items.end(), [part](const PlanItem& item) {
    return item.left_out && item.part == PartName(part);
  });
}

// With the part, and without it: as planned, where the plan leaves it out. Fails where the part
// cannot be forced.
absl::StatusOr<std::array<SolveOptions, 2>> Sides(const Case& run, const Plan& plan, Part part) {
  std::array<SolveOptions, 2> sides = {run.options, run.options};
  sides[0].shoot.parts.with.Add(part);
  if (!LeavesOut(plan, part)) sides[1].shoot.parts.without.Add(part);
  for (const SolveOptions& side : sides) {
    if (absl::Status status = ValidateFor(*run.patches, side); !status.ok()) return status;
  }
  return sides;
}

void Measure(const Case& run, const std::array<SolveOptions, 2>& sides, const char* part) {
  std::vector<Numbers> runs[2], ratios;
  for (int turn = 0; turn < run.turns; ++turn) {
    for (int side : {turn % 2, 1 - turn % 2}) {
      runs[side].push_back(SolveApart(run.patches, sides[side]));
    }
    Numbers& ratio = ratios.emplace_back();
    for (int k = 0; k < kCount; ++k) {
      ratio.of[k] = runs[0].back().of[k] / runs[1].back().of[k];
    }
  }
  std::printf("%-13s %12s %12s %8s\n", part, "with", "without", "ratio");
  for (int k = 0; k < kCount; ++k) {
    const auto value = [k](const Numbers& numbers) { return numbers.of[k]; };
    std::printf("%-13s %12.5g %12.5g %8.3f\n", kNames[k], Median(runs[0], value),
                Median(runs[1], value), Median(ratios, value));
  }
  std::fflush(stdout);
}

int Run(int count, char** arguments) {
  if (count < 6) Fail("plan_bench SCENE.glb PART|all METHOD RAYS TURNS [MAX_EDGE]");
  Case run{Load(arguments[1], count > 6 ? std::atof(arguments[6]) : 0), {}, 1};
  const auto method = ParseMethod(arguments[3]);
  if (!method.ok()) Fail(std::string(method.status().message()));
  run.options.shoot.method = *method;
  run.options.max_rays = static_cast<int64_t>(std::atof(arguments[4]));
  run.turns = std::atoi(arguments[5]);

  const Plan plan = MakePlan(*run.patches, run.options);
  PartSet parts;
  if (std::string(arguments[2]) == "all") {
    for (Part part : AllParts()) {
      if (LeavesOut(plan, part) && Sides(run, plan, part).ok()) parts.Add(part);
    }
  } else if (!parts.Read(arguments[2])) {
    Fail("no such part");
  }
  std::printf("%s, %d patches, %s: %s\n", arguments[1], run.patches->size(),
              MethodName(plan.options.shoot.method), parts.Text().c_str());
  for (Part part : AllParts()) {
    if (!parts.Has(part)) continue;
    const auto sides = Sides(run, plan, part);
    if (!sides.ok()) Fail(std::string(sides.status().message()));
    Measure(run, *sides, PartName(part));
  }
  return 0;
}

}  // namespace
}  // namespace lambert

int main(int argc, char** argv) { return lambert::Run(argc, argv); }
