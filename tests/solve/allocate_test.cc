#include "radiosity/solve/allocate.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

double Sum(Rgb a) { return a.r + a.g + a.b; }

// Emitters of all brightnesses, some of them dark.
std::vector<Rgb> RandomFlux(int count, TestRandom& random) {
  std::vector<Rgb> flux(count);
  for (Rgb& f : flux) {
    const double scale = std::exp2(random.Uniform(-10, 4));
    if (random.Below(4) > 0) f = {scale * random.Uniform(), scale * random.Uniform(), scale};
  }
  return flux;
}

std::vector<UnsentFlux> Unsent(const std::vector<Rgb>& flux_lm) {
  std::vector<UnsentFlux> unsent;
  for (const Rgb& f : flux_lm) unsent.push_back({static_cast<int32_t>(unsent.size()), f});
  return unsent;
}

bool IsPowerOfTwo(double x) {
  int exponent;
  return std::frexp(x, &exponent) == 0.5;
}

// Quanta that a plan shoots, by channel.
std::array<double, 3> TotalQuanta(const StepPlan& plan) {
  std::array<double, 3> total{};
  for (const Visit& visit : plan.visits) {
    for (int c = 0; c < 3; ++c) total[c] += static_cast<double>(visit.quanta[c]);
  }
  return total;
}

// Over a grid of offsets, floor(x + offset) has the mean x up to half a grid step.
TEST(AllocateRays, GivesEveryEmitterItsShareOfTheRaysInTheMean) {
  constexpr int kGrid = 4096;
  TestRandom random(1);
  const std::vector<Rgb> flux = RandomFlux(50, random);
  const double flux_per_ray = 0.37;
  std::vector<double> mean(flux.size());
  for (int k = 0; k < kGrid; ++k) {
    for (const Visit& v : AllocateRays(Unsent(flux), flux_per_ray, (k + 0.5) / kGrid).visits) {
      mean[v.emitter] += 1.0 * v.ray_count / kGrid;
    }
  }
  for (size_t i = 0; i < flux.size(); ++i) {
    EXPECT_NEAR(mean[i], Sum(flux[i]) / flux_per_ray, 1.0 / kGrid) << i;
  }
}

// An emitter that expects a fraction e of a ray sends flux / e once in a while: a mean count that
// is off by 1 / grid, as above, is off by flux_per_ray / grid in flux.
TEST(AllocateRays, ShootsAllFluxOfEveryEmitterInTheMean) {
  constexpr int kGrid = 4096;
  TestRandom random(2);
  const std::vector<Rgb> flux = RandomFlux(50, random);
  const double flux_per_ray = 1.1;
  std::vector<Rgb> mean(flux.size());
  for (int k = 0; k < kGrid; ++k) {
    const StepPlan plan = AllocateRays(Unsent(flux), flux_per_ray, (k + 0.5) / kGrid);
    for (const Visit& v : plan.visits) {
      for (int c = 0; c < 3; ++c) {
        mean[v.emitter][c] += static_cast<double>(v.quanta[c]) * plan.quantum_lm[c] / kGrid;
      }
    }
  }
  for (size_t i = 0; i < flux.size(); ++i) {
    const double slack = Sum(flux[i]) < flux_per_ray ? flux_per_ray / kGrid : 1e-12 * Sum(flux[i]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[i][c], flux[i][c], slack) << i;
  }
}

TEST(AllocateRays, CountsTheRaysOfItsVisitsWhichAreWhole) {
  TestRandom random(3);
  for (int k = 0; k < 100; ++k) {
    const std::vector<Rgb> flux = RandomFlux(40, random);
    const StepPlan plan = AllocateRays(Unsent(flux), random.Uniform(0.01, 3), random.Uniform());
    int64_t rays = 0;
    PatchIndex previous = -1;
    for (const Visit& v : plan.visits) {
      EXPECT_GT(v.emitter, previous) << "visits follow the Morton order of the patches";
      EXPECT_GT(Sum(flux[v.emitter]), 0);
      EXPECT_EQ(v.ray_begin, 0u);
      EXPECT_EQ(v.ray_end, v.ray_count);
      EXPECT_GT(v.ray_count, 0u);
      rays += v.ray_count;
      previous = v.emitter;
    }
    EXPECT_EQ(rays, plan.rays);
  }
}

TEST(AllocateRays, QuantaArePowersOfTwoAndUseTheirRoom) {
  TestRandom random(4);
  for (double scale : {1e-30, 1e-3, 1.0, 1e12, 1e30, 1e100}) {
    std::vector<Rgb> flux = RandomFlux(30, random);
    for (Rgb& f : flux) f = f * Rgb{scale, scale * 1e-12, scale * 1e6};
    const StepPlan plan = AllocateRays(Unsent(flux), scale * 1e5, random.Uniform());
    ASSERT_GT(plan.rays, 0);
    const std::array<double, 3> total = TotalQuanta(plan);
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(IsPowerOfTwo(plan.quantum_lm[c])) << scale;
      EXPECT_LE(total[c], std::exp2(kMaxQuantaBits)) << scale;
      EXPECT_GE(total[c], std::exp2(kMaxQuantaBits - 1) * 0.999) << scale;
    }
  }
}

TEST(AllocateRays, AChannelWithoutFluxHasQuantumZero) {
  const StepPlan plan = AllocateRays(Unsent({{1, 0, 0}, {2, 0, 0}}), 0.5, 0.3);
  EXPECT_EQ(plan.rays, 6);
  EXPECT_GT(plan.quantum_lm.r, 0);
  EXPECT_EQ(plan.quantum_lm.g, 0);
  EXPECT_EQ(plan.quantum_lm.b, 0);
  for (const Visit& v : plan.visits) {
    EXPECT_GT(v.quanta[0], 0);
    EXPECT_EQ(v.quanta[1], 0);
    EXPECT_EQ(v.quanta[2], 0);
  }
}

TEST(AllocateRays, OfNoFluxAreNone) {
  for (const std::vector<Rgb>& flux : {std::vector<Rgb>(), std::vector<Rgb>(5)}) {
    const StepPlan plan = AllocateRays(Unsent(flux), 1, 0.999);
    EXPECT_EQ(plan.rays, 0);
    EXPECT_TRUE(plan.visits.empty());
    EXPECT_EQ(plan.quantum_lm, Rgb{});
  }
}

TEST(AllocateRays, StaysFiniteAtTheEndsOfDoubles) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  const std::vector<std::vector<Rgb>> cases = {
      {{1e-30, 1e-30, 1e-30}}, {{1e30, 1e30, 1e30}}, {{1, 1, 1}, {1e-12, 1e-12, 1e-12}},
      {{kLeast, 0, 0}},        {{1e-310, 1, 1e300}}, {{1e300, 1e300, 1e300}, {kLeast, kLeast, 1}}};
  for (const std::vector<Rgb>& flux : cases) {
    double total = 0;
    for (const Rgb& f : flux) total += Sum(f);
    for (double rays : {0.25, 1.0, 1e6, 1e12}) {
      const StepPlan plan = AllocateRays(Unsent(flux), std::max(total / rays, kLeast), 0.999);
      EXPECT_GE(plan.rays, 0);
      EXPECT_LE(plan.rays, static_cast<int64_t>(flux.size()) << 32);
      const std::array<double, 3> quanta = TotalQuanta(plan);
      for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(std::isfinite(plan.quantum_lm[c]));
        EXPECT_LE(quanta[c], std::exp2(kMaxQuantaBits));
        for (const Visit& v : plan.visits) EXPECT_GE(v.quanta[c], 0);
      }
    }
  }
}

TEST(CutIntoUnits, CoversTheRaysOfEveryVisitExactlyOnce) {
  TestRandom random(5);
  for (int64_t unit_rays : {int64_t{1}, int64_t{7}, int64_t{100}, int64_t{1} << 40}) {
    const StepPlan plan = AllocateRays(Unsent(RandomFlux(60, random)), 0.05, 0.5);
    const std::vector<WorkUnit> units = CutIntoUnits(plan, 11, 12, 13, unit_rays);
    std::map<PatchIndex, uint32_t> next;
    std::map<PatchIndex, Visit> whole;
    for (const Visit& v : plan.visits) whole[v.emitter] = v;
    for (const WorkUnit& unit : units) {
      EXPECT_EQ(unit.seed, 11u);
      EXPECT_EQ(unit.pass, 12u);
      EXPECT_EQ(unit.step, 13u);
      EXPECT_EQ(unit.RayCount(), &unit == &units.back() ? unit.RayCount() : unit_rays);
      EXPECT_LE(unit.RayCount(), unit_rays);
      EXPECT_GT(unit.RayCount(), 0);
      for (Visit v : unit.visits) {
        EXPECT_EQ(v.ray_begin, next[v.emitter]) << "the ranges of a visit follow each other";
        next[v.emitter] = v.ray_end;
        v.ray_begin = 0;
        v.ray_end = v.ray_count;
        EXPECT_EQ(v, whole[v.emitter]) << "parts keep the quanta and rays of the whole";
      }
    }
    for (const Visit& v : plan.visits) EXPECT_EQ(next[v.emitter], v.ray_count);
  }
}

TEST(CutIntoUnits, OfAnEmptyPlanIsNothing) {
  EXPECT_TRUE(CutIntoUnits(StepPlan(), 1, 2, 3, 100).empty());
}

TEST(UnitRays, GrowWithTheStepBetweenFixedBounds) {
  EXPECT_GE(UnitRays(1, 10), 1);
  EXPECT_EQ(UnitRays(1, 10), UnitRays(1000, 10));  // not smaller than an exchange is worth
  EXPECT_EQ(UnitRays(int64_t{1} << 22, 10), 1 << 17);
  EXPECT_EQ(UnitRays(int64_t{1} << 50, 10), UnitRays(int64_t{1} << 51, 10));
  // A unit of a large scene traces half as many rays as it has patches, unless it is too long.
  EXPECT_EQ(UnitRays(1000, 1000000), 500000);
  EXPECT_GE(UnitRays(1000, 40000000), 10000000);
}

}  // namespace
}  // namespace lambert
