// One thing that shoot_bench measures: a scene, a method, so many rays a visit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/bare_embree.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/launcher.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// An office cut into so many patches, and what traces it.
struct BenchScene {
  std::shared_ptr<const PatchSet> patches;
  std::unique_ptr<RayScene> scene;
  std::unique_ptr<BareEmbree> bare;

  // 222 n^2 patches.
  static std::unique_ptr<BenchScene> Make(int n);
};

// What one turn of each took [ns a ray].
struct TurnTimes {
  double bare16 = 0, run = 0;
};
// The stages alone, and Embree otherwise [ns a ray].
struct StageTimes {
  double sample = 0, trace = 0, deposit = 0, bare8 = 0, fast16 = 0;
};

class ShootCase {
 public:
  // `rays` rays over visits of `rays_per_visit` each, to stretches of neighbours that are spread
  // evenly over the patches, in their order. A method that computes densities visits at most
  // kDividedEmitters of them, each several times: the densities are kept from the first time.
  // Ends the program where the recorded rays are not those that the shooter shoots.
  ShootCase(BenchScene& scene, const ShootOptions& options, uint32_t rays_per_visit, int64_t rays);

  static constexpr int64_t kDividedEmitters = 512;

  // One turn of bare rtcIntersect16, then one of Shooter::Run, on the same rays.
  TurnTimes Turn();
  StageTimes Stages();
  // Digest of the shooter's result: equal bytes, equal digests.
  std::string ResultDigest() const;

 private:
  BenchScene& scene_;
  WorkUnit unit_;
  std::shared_ptr<const Shooter> shooter_;
  std::unique_ptr<Launcher> launcher_;
  std::vector<RayBatch> batches_;  // the rays as they are launched, and their hits
  double rays_ = 0;
};

}  // namespace lambert
