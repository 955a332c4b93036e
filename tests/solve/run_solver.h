// Solving in this thread, with a clock that tests turn.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/support/scenes.h"

namespace lambert {

using SharedPatches = std::shared_ptr<const PatchSet>;

inline SharedPatches Share(const Scene& scene) {
  return std::make_shared<const PatchSet>(PatchesOf(scene));
}

// All but exact, which has tests of its own.
inline std::vector<Method> ShootingMethods() {
  std::vector<Method> methods = AllMethods();
  std::erase(methods, Method::kExact);
  return methods;
}

// A method with a budget of rays; pyramids, where used, from visits of 64 rays on.
inline SolveOptions Budget(Method method, int64_t max_rays, uint64_t seed = 1) {
  SolveOptions options;
  options.shoot.method = method;
  options.shoot.pyramids.min_rays = 64;
  if (method == Method::kHs97) options.shoot.pyramids.probes = 1;
  if (method == Method::kImportance) options.shoot.region = {"0"};
  options.max_rays = max_rays;
  options.seed = seed;
  return options;
}

// A solver of a scene, its executor and its clock.
struct SolverRun {
  SolverRun(SharedPatches patches, const SolveOptions& options)
      : plan(MakePlan(*patches, options)),
        executor(*Shooter::Create(patches, plan.options.shoot)),
        solver(patches, plan.options, [this] { return seconds; }) {}
  SolverRun(const SolverRun&) = delete;
  SolverRun& operator=(const SolverRun&) = delete;

  // Runs passes until the solver stops. Every step takes `step_s` on the clock.
  absl::Status ToTheEnd(double step_s = 0) {
    while (solver.stop_reason() == StopReason::kNone) {
      absl::Status status = Pass(step_s);
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }
  absl::Status Pass(double step_s = 0) {
    return solver.RunPass(executor, [&](const Progress& progress) {
      seconds += step_s;
      steps.push_back(progress);
    });
  }
  std::string SolutionBytes() const { return EncodeSolution(*solver.MakeSnapshot().solution); }

  double seconds = 1000;  // a monotonic clock may begin anywhere
  Plan plan;
  SerialExecutor executor;
  Solver solver;
  std::vector<Progress> steps;
};

}  // namespace lambert
