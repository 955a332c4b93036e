// Do runs agree with a reference, patch by patch? Mean z^2, and how far chance alone moves it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/output/patch_table.h"

namespace lambert {

// One run beside the reference, by patch of the reference; radiosity of the green channel, because
// the variance of a channel is known and that of a mean of channels is not.
struct Deviations {
  std::vector<float> difference;  // run less reference [lm/m2]
  std::vector<float> variance;    // of the run, by its own standard error [(lm/m2)^2]
};

// Fails as PairPatches does.
absl::StatusOr<Deviations> DeviationsFrom(const PatchTable& table, const PatchTable& reference);

// Hits of a patch over all runs together, from which its mean is taken to be nearly normal.
inline constexpr double kEnoughHits = 400;

// Over the patches with enough hits:
//   mean_z2  mean of z_i^2, z_i = d_i / sqrt(sum_k v_ik / n^2 + e_i^2), where d_i is the mean over
//            the n runs of the differences, v_ik a run's own variance and e_i the standard error
//            of the reference
//   null     the same of each run k against the mean of all: (d_ik - d_i)^2 / ((1 - 1/n) sum v / n)
// Neighbours share the error of the light that they see, so mean z^2 spreads more than that of
// independent patches, by an amount that depends on scene and method. A run against the other
// runs has that spread and no bias: where no method is wrong, mean_z2 is one more draw of null.
struct Agreement {
  int64_t patches = 0;  // with enough hits
  double mean_z2 = 0;
  std::optional<double> null_z2, null_z2_sd;  // mean and standard deviation; of two runs or more
};

// `rays`: of all runs together. Hits are those that rays of equal flux would have by the reference:
// its share of the flux, so that every method is judged by the same patches. Empty where no patch
// has enough, or no error is stated. Requires: runs; all of this reference.
std::optional<Agreement> Agree(const std::vector<const Deviations*>& runs, double rays,
                               const PatchTable& reference);

}  // namespace lambert
