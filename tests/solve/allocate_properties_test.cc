#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "radiosity/shoot/flight.h"
#include "radiosity/solve/allocate.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

TestRandom AnyRandom() { return TestRandom(*rc::gen::arbitrary<uint64_t>()); }

double Sum(Rgb a) { return a.r + a.g + a.b; }

// Emitters of flux within so many powers of two of one another, dark channels and dark emitters
// between them. From denormals up to 2^1000.
std::vector<UnsentFlux> AnyUnsent(TestRandom& random, int64_t most_octaves) {
  const int64_t octaves = random.Below(most_octaves + 1), low = random.Below(2075 - octaves) - 1075;
  std::vector<UnsentFlux> unsent;
  for (int64_t emitters = random.Below(40); emitters > 0; --emitters) {
    UnsentFlux flux{static_cast<int32_t>(3 * unsent.size()), {}};
    for (int c = 0; c < 3; ++c) {
      if (random.Below(4) == 0) continue;
      flux.flux_lm[c] =
          std::ldexp(random.Uniform(), static_cast<int>(low + random.Below(octaves + 1)));
    }
    unsent.push_back(flux);
  }
  return unsent;
}

Rgb TotalOf(const std::vector<UnsentFlux>& unsent) {
  Rgb total;
  for (const UnsentFlux& flux : unsent) total = total + flux.flux_lm;
  return total;
}

// What an emitter of `flux` sends if it is given rays.
Rgb SentFlux(Rgb flux, double expected) { return expected < 1 ? flux / expected : flux; }

RC_GTEST_PROP(AllocateRays, SendsWholeQuantaOfWhatItAllots, ()) {
  TestRandom random = AnyRandom();
  const std::vector<UnsentFlux> unsent = AnyUnsent(random, 2074);
  const double all = Sum(TotalOf(unsent));
  RC_PRE(all > 0);
  const double per_ray = std::max(all * std::exp2(random.Uniform(-40, 10)), 0x1p-1074);
  const StepPlan plan = AllocateRays(unsent, per_ray, random.Uniform());
  std::map<int32_t, Rgb> flux_of;
  for (const auto& [emitter, flux] : unsent) flux_of[emitter] = flux;
  int64_t rays = 0;
  int32_t previous = -1;
  std::array<double, 3> quanta{};
  for (const Visit& visit : plan.visits) {
    RC_ASSERT(visit.emitter > previous);
    previous = visit.emitter;
    RC_ASSERT(visit.ray_count > 0u);
    RC_ASSERT(visit.ray_begin == 0u && visit.ray_end == visit.ray_count);
    rays += visit.ray_count;
    const Rgb flux = flux_of.at(visit.emitter);
    const Rgb sent = SentFlux(flux, std::min(Sum(flux) / per_ray, 0x1p32 - 1));
    for (int c = 0; c < 3; ++c) {
      const double quantum = plan.quantum_lm[c], count = static_cast<double>(visit.quanta[c]);
      int exponent;
      RC_ASSERT(quantum == 0 || std::frexp(quantum, &exponent) == 0.5);
      RC_ASSERT(visit.quanta[c] >= 0);
      if (quantum == 0) {
        RC_ASSERT(sent[c] == 0);
      } else {
        RC_ASSERT(std::fabs(sent[c] / quantum - count) <= 0.5 + 0x1p-53 * count);
      }
      quanta[c] += count;
    }
  }
  RC_ASSERT(rays == plan.rays);
  for (int c = 0; c < 3; ++c) {
    const double rounded = 0.5 * static_cast<double>(unsent.size());
    RC_ASSERT(quanta[c] <= 0x1p54 + rounded);
    // They use their room, but where there are no smaller quanta.
    if (plan.quantum_lm[c] > 0x1p-1074) RC_ASSERT(quanta[c] >= 0x1p53 * (1 - 0x1p-40) - rounded);
  }
}

// Systematic rounding: after any emitter, the rays so far are those expected so far, to one.
RC_GTEST_PROP(AllocateRays, IsNeverARayAwayFromWhatIsExpectedSoFar, ()) {
  TestRandom random = AnyRandom();
  const std::vector<UnsentFlux> unsent = AnyUnsent(random, 30);
  const double all = Sum(TotalOf(unsent)), offset = random.Uniform();
  RC_PRE(all > 0x1p-900);
  const double per_ray = all * std::exp2(random.Uniform(-20, 5));
  std::vector<double> weights;
  for (int k = 0; k < 60; ++k) weights.push_back(std::exp2(random.Uniform(-4, 4)));
  std::map<int32_t, uint32_t> rays_of;
  for (const Visit& v : AllocateRays(unsent, per_ray, offset, weights).visits) {
    rays_of[v.emitter] = v.ray_count;
  }
  double expected = offset, rays = 0;
  for (const auto& [emitter, flux] : unsent) {
    const bool weighted = static_cast<size_t>(emitter) < weights.size();
    expected += (weighted ? weights[emitter] : 1) * Sum(flux) / per_ray;
    rays += rays_of[emitter];
    const double rounding = 1e-13 * expected;
    RC_ASSERT(rays <= expected + rounding);
    RC_ASSERT(rays > expected - 1 - rounding);
  }
}

// floor(x + offset) over a grid of G offsets has the mean x to 1 / G; rays are a difference of two.
RC_GTEST_PROP(AllocateRays, GivesTheExpectedRaysAndFluxInTheMean, ()) {
  constexpr int kGrid = 256;
  TestRandom random = AnyRandom();
  const std::vector<UnsentFlux> unsent = AnyUnsent(random, 12);
  const double all = Sum(TotalOf(unsent));
  RC_PRE(all > 0x1p-900);
  const double per_ray = all / random.Uniform(1, 200);
  std::map<int32_t, double> rays_of;
  std::map<int32_t, Rgb> flux_of;
  for (int k = 0; k < kGrid; ++k) {
    const StepPlan plan = AllocateRays(unsent, per_ray, (k + 0.5) / kGrid);
    for (const Visit& v : plan.visits) {
      rays_of[v.emitter] += 1.0 * v.ray_count / kGrid;
      for (int c = 0; c < 3; ++c) {
        flux_of[v.emitter][c] += static_cast<double>(v.quanta[c]) * plan.quantum_lm[c] / kGrid;
      }
    }
  }
  for (const auto& [emitter, flux] : unsent) {
    const double expected = Sum(flux) / per_ray;
    RC_ASSERT(std::fabs(rays_of[emitter] - expected) <= 2.0 / kGrid);
    const double slack = expected < 1 ? 2 * per_ray / kGrid : 1e-12 * all;
    for (int c = 0; c < 3; ++c) RC_ASSERT(std::fabs(flux_of[emitter][c] - flux[c]) <= slack);
  }
}

// Units of any size, and the rays that they deal quanta to: each ray of a visit gets what it gets
// where the visit is one unit.
RC_GTEST_PROP(CutIntoUnits, DealsTheSameQuantaToEachRayHoweverItCuts, ()) {
  TestRandom random = AnyRandom();
  const std::vector<UnsentFlux> unsent = AnyUnsent(random, 40);
  const double all = Sum(TotalOf(unsent));
  RC_PRE(all > 0x1p-900);
  const StepPlan plan = AllocateRays(unsent, all / random.Uniform(1, 2000), random.Uniform());
  const auto dealt = [&plan](int64_t unit_rays) {
    std::map<int32_t, std::vector<Quanta>> rays;
    for (const WorkUnit& unit : CutIntoUnits(plan, 1, 2, 3, unit_rays)) {
      RC_ASSERT(unit.RayCount() <= unit_rays);
      for (const Visit& visit : unit.visits) {
        const RayDeal deal(visit.quanta, visit.ray_count);
        RC_ASSERT(visit.ray_begin == rays[visit.emitter].size());
        for (uint32_t ray = visit.ray_begin; ray < visit.ray_end; ++ray) {
          const Long4 flux = deal.Of(ray);
          rays[visit.emitter].push_back({flux[0], flux[1], flux[2]});
        }
      }
    }
    return rays;
  };
  const auto whole = dealt(std::numeric_limits<int64_t>::max());
  RC_ASSERT(dealt(1 + random.Below(200)) == whole);
  RC_ASSERT(whole.size() == plan.visits.size());
  for (const Visit& visit : plan.visits) {
    Quanta sum{};
    for (const Quanta& ray : whole.at(visit.emitter)) {
      for (int c = 0; c < 3; ++c) sum[c] += ray[c];
    }
    RC_ASSERT(sum == visit.quanta);
  }
}

TEST(AllocateRays, SendsTheLeastFluxThatThereIs) {
  constexpr double kLeast = 0x1p-1074;
  const StepPlan plan = AllocateRays({{0, {kLeast, 3 * kLeast, 0}}}, kLeast, 0.5);
  ASSERT_EQ(plan.visits.size(), 1u);
  EXPECT_EQ(plan.quantum_lm, (Rgb{kLeast, kLeast, 0}));
  EXPECT_EQ(plan.visits[0].quanta, (Quanta{1, 3, 0}));
}

TEST(AllocateRays, SendsNothingOfAnEmitterOf1eMinus300BesideOneOf1e300) {
  const std::vector<UnsentFlux> unsent = {
      {0, {1e-300, 0, 0}}, {1, {1e300, 0, 0}}, {2, {1e-300, 0, 0}}};
  for (double offset : {0.0, 0.5, 1 - 0x1p-53}) {
    const StepPlan plan = AllocateRays(unsent, 1e297, offset);
    ASSERT_EQ(plan.visits.size(), 1u);
    EXPECT_EQ(plan.visits[0].emitter, 1);
    EXPECT_NEAR(plan.rays, 1000, 1);
    EXPECT_DOUBLE_EQ(static_cast<double>(plan.visits[0].quanta[0]) * plan.quantum_lm.r, 1e300);
  }
}

// A bright emitter leaves dim ones after it their share: what rounding takes is of a ray, not of
// all.
TEST(AllocateRays, ABrightEmitterTakesNothingFromDimOnesAfterIt) {
  std::vector<UnsentFlux> unsent = {{0, {4e9, 0, 0}}};
  for (int32_t k = 1; k <= 1000; ++k) unsent.push_back({k, {1e-7, 0, 0}});
  int64_t rays = 0;
  constexpr int kGrid = 10000;
  for (int k = 0; k < kGrid; ++k) {
    const StepPlan plan = AllocateRays(unsent, 1, (k + 0.5) / kGrid);
    rays += plan.rays - 4000000000;
  }
  EXPECT_NEAR(static_cast<double>(rays) / kGrid, 1e-4, 1.0 / kGrid);
  EXPECT_GT(rays, 0);
}

}  // namespace
}  // namespace lambert
