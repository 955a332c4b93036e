// What a distributed run must end with.
#pragma once

#include <memory>
#include <string>

#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/support/scenes.h"

namespace lambert {

inline constexpr int kSquares = 4;  // the Cornell box of all these tests: 512 patches

inline SceneBundle CornellBundle() { return {"room.glb", ToGlb(MakeCornell(kSquares)), {}}; }

// The solution's bytes of the loop that runs in one thread without a network.
inline std::string SolveSerially(const SolveOptions& options) {
  auto patches = std::make_shared<const PatchSet>(*BuildPatches(*LoadGltf(CornellBundle()), {}));
  const Plan plan = MakePlan(*patches, options);
  SerialExecutor executor(*Shooter::Create(patches, plan.options.shoot));
  Solver solver(patches, plan.options, [] { return 0.0; });
  while (solver.stop_reason() == StopReason::kNone) {
    if (!solver.RunPass(executor, nullptr).ok()) break;
  }
  return EncodeSolution(*solver.MakeSnapshot().solution);
}

}  // namespace lambert
