#include "radiosity/exact/exact_solver.h"

#include <algorithm>
#include <cmath>

#include "radiosity/exact/balance.h"

namespace lambert {
namespace {

// Links of patches that reflect nothing still get samples: their irradiance is reported.
constexpr double kLeastReflectance = 0.05;
// No link's weight is under this share of the mean. What the pilot did not see may be large, and a
// sample counts by the inverse of its chance: at a tenth of the rays none counts by much.
constexpr double kLeastWeight = 0.1;

std::vector<double> MeanReflectance(const PatchSet& patches) {
  std::vector<double> mean;
  for (const Rgb& rho : patches.reflectance) mean.push_back(Mean(rho));
  return mean;
}

}  // namespace

ExactSolver::ExactSolver(const PatchSet& patches, const RayScene& scene, bool may_hide)
    : patches_(patches), exchange_(patches, scene, may_hide) {}

Transport ExactSolver::SampleTransport(const std::vector<double>& emitted, int64_t rays,
                                       uint64_t seed, uint32_t pass) const {
  if (exchange_.links().empty()) return exchange_.Guess();
  return exchange_.Sample(LinkWeights(emitted), rays, seed, pass);
}

// The variance of a link's exchange, times what it does to sum A B^2: an error dG changes
//   B_i by rho_i B_j dG / A_i  and  B_j by rho_j B_i dG / A_j.
std::vector<double> ExactSolver::LinkWeights(const std::vector<double>& emitted) const {
  const std::vector<double> rho = MeanReflectance(patches_);
  const PatchIndex n = patches_.size();
  // Where the guess cannot be solved, what is emitted tells enough.
  const auto arrived = Solve(exchange_.Guess(), emitted, rho).value_or(std::vector<double>(n));
  const auto radiosity = [&](PatchIndex i) {
    return (emitted[i] + rho[i] * arrived[i]) / patches_.area_m2[i];
  };
  // Root of area-weighted square that one unit of light sent to patch i adds.
  const auto effect = [&](PatchIndex i, double sent) {
    const double reflected = std::max(rho[i], kLeastReflectance) * sent;
    return reflected * reflected / patches_.area_m2[i];
  };
  std::vector<double> weights;
  weights.reserve(exchange_.links().size());
  double sum = 0;
  for (const Link& link : exchange_.links()) {
    const double square =
        link.j >= n ? effect(link.i, emitted[link.j])
                    : effect(link.i, radiosity(link.j)) + effect(link.j, radiosity(link.i));
    weights.push_back(link.spread * std::sqrt(square));
    sum += weights.back();
  }
  const double least = sum > 0 ? kLeastWeight * sum / static_cast<double>(weights.size()) : 1;
  for (double& weight : weights) weight = std::max(weight, least);
  return weights;
}

absl::StatusOr<std::vector<double>> ExactSolver::Solve(
    const Transport& transport, const std::vector<double>& emitted,
    const std::vector<double>& reflectance) const {
  const PatchIndex n = patches_.size();
  Lighting lighting{patches_.area_m2,
                    reflectance,
                    {emitted.begin(), emitted.begin() + n},
                    std::vector<double>(n)};
  for (size_t l = 0; l < transport.lights.size(); ++l) {
    for (PatchIndex i = 0; i < n; ++i) {
      lighting.direct[i] += transport.lights[l][i] * emitted[n + l];
    }
  }
  return ArrivedFlux(transport.exchange, lighting);
}

}  // namespace lambert
