// Random walks: flux goes on from the very points that rays hit, until all of it is absorbed or
// has left the scene.
//
// Every arrival counts (the collision estimator of Bek99). So a patch's irradiance is the mean over
// it of what arrives there when light is not spread evenly over the patches between: that of the
// continuous scene, whatever the size of patches (PM92). Only reflectance and emission are one
// value a patch.
#pragma once

#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/flight.h"

namespace lambert {

// A flight whose rays go on. They end by roulette: of a ray with flux phi w that hits reflectance
// rho, w at most 1 and 1 in some channel, so survives p = max_c rho_c w_c, with flux phi rho w / p.
// No ray ever carries more than it began with, and what arrives is right in the mean in each
// channel. The numbers of a bounce are named by the walk's first ray and the bounce.
class WalkFlight : public Flight {
 public:
  // `emitters` and `reflectance` (of each patch) must outlive it, as must `unit`.
  WalkFlight(const RayScene& scene, const Emitters& emitters, const std::vector<Rgb>& reflectance,
             const WorkUnit& unit, Arrivals& arrivals, UnitResult& result)
      : Flight(scene, arrivals, result, /*watch=*/false),
        emitters_(emitters),
        reflectance_(reflectance),
        unit_(unit) {}

  // Follows all rays of the batch to their ends. Fails with FAILED_PRECONDITION
  // (SINGULAR_CLOSED_RHO_1) where they have none.
  void Land() override;

 private:
  // A ray that goes on: where from, and two numbers for where to. Eight at a time.
  struct alignas(32) Onward {
    uint32_t at[8];
    float u[8], v[8], direction[2][8];
  };

  // Puts the walks of those of `rays` rays first that have hit and go on; how many these are.
  // `stream`: of the bounce.
  int Survive(int rays, const RandomStream& stream);

  const Emitters& emitters_;
  const std::vector<Rgb>& reflectance_;
  const WorkUnit& unit_;
  int64_t rays_without_loss_ = 0;
  // Of the walk of each slot: its name, what it began with, and w of that, 1 of the ray itself.
  alignas(64) uint32_t emitter_[RayBatch::kSlots], ray_[RayBatch::kSlots];
  alignas(64) Long4 whole_[RayBatch::kSlots];
  alignas(64) Double4 share_[RayBatch::kSlots];
  Onward onward_[RayBatch::kSlots / 8];
};

}  // namespace lambert
