// What is shot equals what was given, in expectation, and arrives where it should.
#include <gtest/gtest.h>

#include <string>

#include "radiosity/shoot/shooter.h"
#include "tests/support/deposits.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

std::shared_ptr<const PatchSet> Patches() {
  static const auto patches = std::make_shared<const PatchSet>(PatchesOf(MakeCornell(1)));
  return patches;
}

// PHS for every visit, however few its rays: most pyramids then expect a fraction of a ray.
ShootOptions Phs(PyramidSampling sampling, double alpha1, double alpha2) {
  ShootOptions options;
  options.method = Method::kPhs;
  options.pyramids.sampling = sampling;
  options.pyramids.alpha1 = alpha1;
  options.pyramids.alpha2 = alpha2;
  options.pyramids.min_rays = 1;
  return options;
}

std::vector<ShootOptions> PhsOptions() {
  return {Phs(PyramidSampling::kProjectedAngle, 1, 1), Phs(PyramidSampling::kSolidAngle, 1, 1),
          Phs(PyramidSampling::kProjectedAngle, 0, 1), Phs(PyramidSampling::kSolidAngle, 0, 1)};
}

TEST(PhsFlux, ShotEqualsTheQuantaInExpectationWithFewRays) {
  const Quanta quanta = {int64_t{1} << 40, 3000000007, 12345};
  for (const ShootOptions& options : PhsOptions()) {
    const auto shooter = *Shooter::Create(Patches(), options);
    for (uint32_t rays : {1u, 5u, 64u}) {
      SampleMean shot[3];
      for (uint64_t seed = 0; seed < 6000 / rays + 1000; ++seed) {
        const absl::StatusOr<UnitResult> result =
            shooter->Run({seed, 0, 0, {{4, rays, 0, rays, quanta}}});
        ASSERT_TRUE(result.ok()) << result.status();
        for (int c = 0; c < 3; ++c) shot[c].Add(static_cast<double>(result->shot[c]));
      }
      for (int c = 0; c < 3; ++c) {
        // Rays carry whole quanta: each is off by half a quantum at most.
        const double slack = kSigmas * shot[c].std_error() + 0.5 * rays;
        EXPECT_NEAR(shot[c].mean(), static_cast<double>(quanta[c]), slack)
            << rays << " rays, channel " << c << ", alpha1 " << options.pyramids.alpha1;
      }
    }
  }
}

TEST(PhsFlux, WithManyRaysAndEqualFluxARayHardlyLeavesAResidual) {
  const auto shooter = *Shooter::Create(Patches(), Phs(PyramidSampling::kProjectedAngle, 1, 1));
  // Every pyramid expects a ray or more, so each sends f_p of the quanta, to the nearest one.
  const Quanta quanta = {1000000007, 99999, 64};
  const UnitResult result = *shooter->Run({3, 0, 0, {{4, 20000, 0, 20000, quanta}}});
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(result.shot[c], quanta[c], 32);  // 64 pyramids, a half each
}

// Deposits by seed, mean and standard error by patch.
std::vector<SampleMean> Deposits(const ShootOptions& options, PatchIndex emitter, uint32_t rays) {
  const auto shooter = *Shooter::Create(Patches(), options);
  std::vector<SampleMean> deposits(Patches()->size());
  for (uint64_t seed = 0; seed < 300; ++seed) {
    const UnitResult result =
        *shooter->Run({seed, 0, 0, {{emitter, rays, 0, rays, {int64_t{1} << 40, 0, 0}}}});
    for (const Deposit& d : ByPatch(result, Patches()->size())) {
      deposits[d.patch].Add(static_cast<double>(d.r));
    }
  }
  return deposits;
}

TEST(PhsFlux, ArrivesWhereThatOfPmcrArrives) {
  const PatchIndex emitter = 9;
  ShootOptions pmcr;
  const std::vector<SampleMean> expected = Deposits(pmcr, emitter, 1500);
  for (const ShootOptions& options : PhsOptions()) {
    const std::vector<SampleMean> deposits = Deposits(options, emitter, 300);
    double z2 = 0;
    int compared = 0;
    for (size_t i = 0; i < expected.size(); ++i) {
      const double se = std::hypot(expected[i].std_error(), deposits[i].std_error());
      const bool seen = expected[i].mean() > 10 * expected[i].std_error();
      if (!seen) continue;  // too few hits for a mean that is nearly normal
      z2 += std::pow((deposits[i].mean() - expected[i].mean()) / se, 2);
      ++compared;
    }
    ASSERT_GE(compared, 8);
    EXPECT_LT(z2 / compared, MeanZ2Limits(compared).high);
    EXPECT_GT(z2 / compared, MeanZ2Limits(compared).low);
  }
}

TEST(PointLightFlux, FromTheCentreOfACubeReachesItsSixFacesAlike) {
  PatchSet cube = PatchesOf(MakeFurnace(0.5));
  cube.lights.push_back({"", {0, 0, 0}, {1, 1, 1}});
  const auto patches = std::make_shared<const PatchSet>(cube);
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    ShootOptions options;
    options.method = method;
    const auto shooter = *Shooter::Create(patches, options);
    const WorkUnit unit{1, 0, 0, {{patches->size(), 60000, 0, 60000, {60000, 0, 0}}}};
    const UnitResult result = *shooter->Run(unit);
    EXPECT_EQ(result.escaped, Quanta{});
    std::vector<int64_t> faces(6);
    for (const Deposit& d : result.deposits) {
      EXPECT_EQ(d.r, d.hits) << "each ray carries one quantum";
      faces[patches->source[d.patch].primitive] += d.hits;
    }
    EXPECT_LT(ChiSquared(faces, std::vector<double>(6, 1.0 / 6)), ChiSquaredQuantile(5));
  }
}

TEST(PhsFlux, PyramidsOfTheLeastDensityDoNotOverflowTheQuantaOfAStep) {
  // All flux that a step may shoot, on one patch, with so few rays that each carries most of it.
  constexpr int64_t kAll = int64_t{1} << kMaxQuantaBits;
  for (const ShootOptions& options : PhsOptions()) {
    const auto shooter = *Shooter::Create(Patches(), options);
    for (uint64_t seed = 0; seed < 2000; ++seed) {
      const WorkUnit unit{seed, 0, 0, {{4, 2, 0, 2, {kAll, kAll, kAll}}}};
      const UnitResult result = *shooter->Run(unit);
      ASSERT_TRUE(CheckLedger(unit, result).ok()) << CheckLedger(unit, result);
      ASSERT_GE(result.shot[0], 0);
    }
  }
}

}  // namespace
}  // namespace lambert
