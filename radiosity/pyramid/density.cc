#include "radiosity/pyramid/density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lambert {
namespace {

constexpr double kDefensiveShare = 0.01;  // of f_p: bounds a ray's weight at 100 times the mean

}  // namespace

std::vector<float> PyramidDensities(const Hemisphere& hemisphere,
                                    const std::vector<int32_t>& counts, double alpha1,
                                    double alpha2) {
  const int64_t total = std::accumulate(counts.begin(), counts.end(), int64_t{0});
  std::vector<double> density(hemisphere.size());
  double sum = 0;
  for (int p = 0; p < hemisphere.size(); ++p) {
    const double f = hemisphere.pyramid(p).flux_fraction();
    const double g = total > 0 ? static_cast<double>(counts[p]) / static_cast<double>(total) : f;
    density[p] = std::max((alpha1 * f + alpha2 * g) / (alpha1 + alpha2), kDefensiveShare * f);
    sum += density[p];
  }
  std::vector<float> result(density.size());
  for (size_t p = 0; p < density.size(); ++p) result[p] = static_cast<float>(density[p] / sum);
  return result;
}

std::vector<uint32_t> PyramidRays(const std::vector<float>& densities, uint32_t ray_count,
                                  double offset) {
  double sum = 0;
  for (float density : densities) sum += density;
  std::vector<uint32_t> rays(densities.size());
  double cumulative = 0;
  uint64_t before = 0;
  for (size_t p = 0; p < densities.size(); ++p) {
    cumulative += densities[p];
    const uint64_t until =
        p + 1 == densities.size()
            ? ray_count
            : std::min<uint64_t>(ray_count, static_cast<uint64_t>(
                                                std::floor(cumulative / sum * ray_count + offset)));
    rays[p] = static_cast<uint32_t>(until - before);
    before = until;
  }
  return rays;
}

}  // namespace lambert
