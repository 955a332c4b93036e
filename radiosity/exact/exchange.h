// Who exchanges light with whom, and how much of it occlusion leaves: once in closed form, then by
// samples of the pairs that something may stand between.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/exact/exchange_matrix.h"
#include "radiosity/exact/light_fraction.h"
#include "radiosity/exact/segments.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// What every patch gets of a light's flux: [light][patch].
using LightFractions = std::vector<std::vector<double>>;

struct Transport {
  ExchangeMatrix exchange;  // A_i F_ij [m2]
  LightFractions lights;
};

// A pair that may be occluded.
struct Link {
  PatchIndex i = 0;
  PatchIndex j = 0;   // > i; or patches.size() + l for light l
  float control = 0;  // visible fraction, guessed
  float spread = 0;   // standard deviation of one sample of the exchange, guessed
};

// Immutable after construction, which is the long part: closed forms of all pairs, then a pilot of
// a few segments for each that is not surely clear. The pilot's random numbers are no pass's, so
// what it guesses may steer the samples of a pass without biasing them.
class Exchange {
 public:
  // The patch set and the ray scene must outlive it. `may_hide` false: nothing hides anything, no
  // pair is looked at and no ray traced. Requires: it is true, or the scene is convex.
  Exchange(const PatchSet& patches, const RayScene& scene, bool may_hide = true);

  const std::vector<Link>& links() const { return links_; }

  // With the pilot's guess for every link.
  Transport Guess() const;

  // With samples: about `rays` segments, dealt over the links in proportion to weights (> 0, one
  // for each link), keyed by seed and pass. With w the kernel's weight of a sample, V its
  // visibility and c the link's control, a link of n samples has the unbiased
  //   c A_i F_ij + 1/n sum w (V - c)
  // which is exact where the guess is. Rows of a closed scene are made to sum to one. A link that
  // expects under one sample gets one by chance and divides by what it expected.
  Transport Sample(const std::vector<double>& weights, int64_t rays, uint64_t seed,
                   uint32_t pass) const;

 private:
  void AddLights(bool may_hide);
  void RunPilot();
  Segments SegmentsOf(const Link& link) const;
  static double& Entry(const Link& link, Transport& transport);

  const PatchSet& patches_;
  const RayScene& scene_;
  const bool is_closed_;
  std::vector<LightFraction> lights_;
  Transport unoccluded_;
  std::vector<Link> links_;
};

}  // namespace lambert
