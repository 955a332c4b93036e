#include "radiosity/solve/allocate.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

constexpr int64_t kUnitsPerStep = 32;           // enough to balance a dozen workers
constexpr int64_t kMinUnitRays = 1 << 14;       // about 4 ms: more than an exchange costs
constexpr int64_t kMaxUnitRays = 1 << 21;       // about half a second
constexpr double kMaxVisitRays = 4294967295.0;  // ray numbers have 32 bits

struct Share {
  int32_t emitter;
  uint32_t rays;
  Rgb flux_lm;
};

// The power of two of which `total` takes at most 2^kMaxQuantaBits; 0 for no flux.
double Quantum(double total_lm) {
  return total_lm > 0 ? std::ldexp(1.0, std::ilogb(total_lm) + 1 - kMaxQuantaBits) : 0.0;
}

}  // namespace

StepPlan AllocateRays(const std::vector<UnsentFlux>& unsent, double flux_per_ray_lm, double offset,
                      const std::vector<double>& weights) {
  std::vector<Share> shares;
  Rgb total;
  double cumulative = offset, whole = 0;
  for (const auto& [emitter, flux] : unsent) {
    const double scalar = flux.r + flux.g + flux.b;
    if (!(scalar > 0)) continue;
    const bool weighted = static_cast<size_t>(emitter) < weights.size();
    const double weight = weighted ? weights[emitter] : 1;
    const double expected = std::min(weight * scalar / flux_per_ray_lm, kMaxVisitRays);
    cumulative += expected;
    const double until = std::floor(cumulative);
    const double rays = std::min(until - whole, kMaxVisitRays);
    whole = until;
    if (rays < 1) continue;
    const Rgb sent = expected < 1 ? flux / expected : flux;
    shares.push_back({emitter, static_cast<uint32_t>(rays), sent});
    total = total + sent;
  }
  StepPlan plan;
  plan.quantum_lm = {Quantum(total.r), Quantum(total.g), Quantum(total.b)};
  plan.visits.reserve(shares.size());
  for (const Share& share : shares) {
    Visit visit{share.emitter, share.rays, 0, share.rays, {}};
    for (int c = 0; c < 3; ++c) {
      const double quantum = plan.quantum_lm[c];
      if (quantum > 0) visit.quanta[c] = std::llround(share.flux_lm[c] / quantum);
    }
    plan.rays += share.rays;
    plan.visits.push_back(visit);
  }
  return plan;
}

std::vector<WorkUnit> CutIntoUnits(const StepPlan& plan, uint64_t seed, uint32_t pass,
                                   uint32_t step, int64_t unit_rays) {
  std::vector<WorkUnit> units;
  int64_t room = 0;
  for (const Visit& visit : plan.visits) {
    for (uint32_t begin = 0; begin < visit.ray_count;) {
      if (room == 0) {
        units.push_back({seed, pass, step, {}});
        room = unit_rays;
      }
      Visit part = visit;
      part.ray_begin = begin;
      part.ray_end = static_cast<uint32_t>(std::min<int64_t>(visit.ray_count, begin + room));
      units.back().visits.push_back(part);
      room -= part.ray_end - part.ray_begin;
      begin = part.ray_end;
    }
  }
  return units;
}

int64_t UnitRays(int64_t step_rays, int64_t patch_count) {
  // A result lists the patches that were hit: a unit should have more rays to trace than to report.
  const int64_t least = std::max(kMinUnitRays, patch_count / 4);
  return std::min(std::max(step_rays / kUnitsPerStep, least), std::max(kMaxUnitRays, least));
}

}  // namespace lambert
