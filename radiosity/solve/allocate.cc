#include "radiosity/solve/allocate.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

constexpr int64_t kUnitsPerStep = 32;           // enough to balance a dozen workers
constexpr int64_t kMinUnitRays = 1 << 14;       // about 4 ms: more than an exchange costs
constexpr int64_t kMaxUnitRays = 1 << 18;       // about 50 ms; many are lent together
constexpr int64_t kLongUnitRays = 1 << 24;      // about three seconds
constexpr double kMaxVisitRays = 4294967295.0;  // ray numbers have 32 bits

struct Share {
  int32_t emitter;
  uint32_t rays;
  Rgb flux_lm;
};

// Of a finished solution: leaves two bits to its rounding and to the sign.
constexpr int kSolvedBits = 61;
constexpr double kLeastLoss =
    0x1p-23;  // 1 - rho, under which more could arrive than is planned for

// The power of two of which `total` takes at most 2^bits; 0 for no flux.
double Quantum(double total_lm, int bits) {
  constexpr int kLeast = -1074;  // of a double: every other one is a multiple of it
  return total_lm > 0 ? std::ldexp(1.0, std::max(std::ilogb(total_lm) + 1 - bits, kLeast)) : 0.0;
}

Quanta InQuanta(const Rgb& flux_lm, const Rgb& quantum_lm) {
  Quanta quanta{};
  for (int c = 0; c < 3; ++c) {
    if (quantum_lm[c] > 0) quanta[c] = std::llround(flux_lm[c] / quantum_lm[c]);
  }
  return quanta;
}

}  // namespace

StepPlan AllocateRays(const std::vector<UnsentFlux>& unsent, double flux_per_ray_lm, double offset,
                      const std::vector<double>& weights, int quanta_bits) {
  std::vector<Share> shares;
  Rgb total;
  double due = offset;  // a whole number of rays is, the rest is carried on
  for (const auto& [emitter, flux] : unsent) {
    const double scalar = ChannelSum(flux);
    if (!(scalar > 0)) continue;
    const bool weighted = static_cast<size_t>(emitter) < weights.size();
    const double weight = weighted ? weights[emitter] : 1;
    const double expected = std::min(weight * scalar / flux_per_ray_lm, kMaxVisitRays);
    due += expected;
    const double rays = std::min(std::floor(due), kMaxVisitRays);
    due -= std::floor(due);
    if (rays < 1) continue;
    const Rgb sent = expected < 1 ? flux / expected : flux;
    shares.push_back({emitter, static_cast<uint32_t>(rays), sent});
    total = total + sent;
  }
  StepPlan plan;
  for (int c = 0; c < 3; ++c) plan.quantum_lm[c] = Quantum(total[c], quanta_bits);
  plan.visits.reserve(shares.size());
  for (const Share& share : shares) {
    plan.rays += share.rays;
    plan.visits.push_back(
        {share.emitter, share.rays, 0, share.rays, InQuanta(share.flux_lm, plan.quantum_lm)});
  }
  return plan;
}

StepPlan PlanWholePass(const std::vector<UnsentFlux>& unsent, const PatchSet& patches,
                       int64_t rays) {
  StepPlan plan;
  if (unsent.empty()) return plan;
  Rgb total, most;
  for (const UnsentFlux& emitter : unsent) total = total + emitter.flux_lm;
  for (const Rgb& rho : patches.reflectance) {
    for (int c = 0; c < 3; ++c) most[c] = std::max(most[c], rho[c]);
  }
  for (int c = 0; c < 3; ++c) {
    plan.quantum_lm[c] = Quantum(total[c] / std::max(1 - most[c], kLeastLoss), kSolvedBits);
  }
  const auto emitters = static_cast<int64_t>(unsent.size());
  plan.rays = std::min(std::max(rays, emitters + patches.size()),
                       emitters * static_cast<int64_t>(kMaxVisitRays));
  for (int64_t k = 0; k < emitters; ++k) {
    const auto share = static_cast<uint32_t>(plan.rays / emitters + (k < plan.rays % emitters));
    plan.visits.push_back(
        {unsent[k].emitter, share, 0, share, InQuanta(unsent[k].flux_lm, plan.quantum_lm)});
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
        units.push_back({seed, pass, step, {}, plan.rays_per_m2, plan.channels, plan.walks});
        room = unit_rays;
      }
      Visit part = visit;
      if (plan.channels == kGrayChannels) part.quanta = {part.quanta[0], 0, 0};
      part.ray_begin = begin;
      part.ray_end =
          begin + static_cast<uint32_t>(std::min<int64_t>(visit.ray_count - begin, room));
      units.back().visits.push_back(part);
      room -= part.ray_end - part.ray_begin;
      begin = part.ray_end;
    }
  }
  return units;
}

int64_t UnitRays(int64_t step_rays, int64_t patch_count) {
  // A result lists the patches that were hit: a unit should have more rays to trace than to report,
  // and half as many rays as patches, as workers add up what they trace, unless it would run too
  // long (docs/scaling.md).
  const int64_t least =
      std::max({kMinUnitRays, std::min(patch_count / 2, kLongUnitRays), patch_count / 4});
  return std::min(std::max(step_rays / kUnitsPerStep, least), std::max(kMaxUnitRays, least));
}

}  // namespace lambert
