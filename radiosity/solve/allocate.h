// Which emitter shoots how many rays in a step, carrying which flux: the paper's figure 1 with
// unbiased rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// Flux that an emitter has yet to send.
struct UnsentFlux {
  int32_t emitter = 0;  // a patch, or patches + l for point light l
  Rgb flux_lm;
  bool operator==(const UnsentFlux&) const = default;
};

// The visits of one step. Flux in lumen = quanta * quantum_lm, per channel.
struct StepPlan {
  std::vector<Visit> visits;  // whole visits: ray_begin 0, ray_end ray_count
  Rgb quantum_lm;             // a power of two, 2^-1074 or more; 0 for a channel without flux
  int64_t rays = 0;
  double rays_per_m2 = 0;  // WorkUnit's, for methods that want it
  // Of its units. Gray: the visits' channels are alike, and the first travels.
  int channels = kColorChannels;
  bool walks = false;  // WorkUnit's
};

// Emitter i expects e_i = weight_i flux_i / flux_per_ray rays (flux: the sum of its channels;
// weight: by emitter, 1 where the list ends before it); the numbers are rounded systematically over
// the emitters from `offset` in [0, 1), so that E[rays_i] = e_i. An emitter that expects less than
// one ray sends its flux / e_i when it gets one: Russian roulette, no flux is lost in expectation.
// All flux that is shot is at most 2^quanta_bits quanta and half a quantum an emitter. Requires:
// finite flux >= 0 of a finite sum, flux_per_ray > 0, weights > 0, quanta_bits in
// 1..kMaxQuantaBits.
//
// At the ends of the scale: no flux, no visit. No emitter gets more than 2^32 - 1 rays, and one
// that expects under 2^-54 may get none in any case. What an emitter sends is rounded to the
// nearest quantum: less than half a quantum, 2^-55 of the channel, is none. Denormal flux is a
// whole number of quanta of 2^-1074. What is not sent is the step's residual (flux_ledger.h).
StepPlan AllocateRays(const std::vector<UnsentFlux>& unsent, double flux_per_ray_lm, double offset,
                      const std::vector<double>& weights = {}, int quanta_bits = kMaxQuantaBits);

// The whole emission in one step, for a method that returns a finished solution: each emitter has
// one visit, and `rays`, or as many as there are emitters and patches where that is more, are dealt
// over them evenly. What arrives over all bounces, at most 1 / (1 - rho) times the emission with
// rho the greatest reflectance of a channel, is under 2^61 quanta; where rho is over 1 - 2^-23,
// that stands for it. Requires: finite flux >= 0 of a finite sum, rays > 0.
StepPlan PlanWholePass(const std::vector<UnsentFlux>& unsent, const PatchSet& patches,
                       int64_t rays);

// Cuts the visits into units of about `unit_rays` rays; long visits are divided. The results of the
// units, merged, do not depend on how they were cut. Requires: unit_rays >= 1.
std::vector<WorkUnit> CutIntoUnits(const StepPlan& plan, uint64_t seed, uint32_t pass,
                                   uint32_t step, int64_t unit_rays);

// Rays of one unit for a step: a function of the step and the scene alone, never of the workers.
int64_t UnitRays(int64_t step_rays, int64_t patch_count);

}  // namespace lambert
