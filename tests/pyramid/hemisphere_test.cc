#include "radiosity/pyramid/hemisphere.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/sphere_bins.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

struct Cut {
  int initial, split, depth;
  int Pyramids() const { return initial * static_cast<int>(std::pow(split, depth)); }
  std::string Name() const {
    return std::to_string(initial) + " initial, split " + std::to_string(split) + ", depth " +
           std::to_string(depth);
  }
};

std::vector<Cut> Cuts() {
  std::vector<Cut> cuts;
  for (int initial = 3; initial <= 9; ++initial) {
    for (int split : {3, 4}) {
      for (int depth = 0; depth <= 3; ++depth) cuts.push_back({initial, split, depth});
    }
  }
  cuts.push_back({64, 4, 2});
  cuts.push_back({4, 4, 5});
  return cuts;
}

TEST(Hemisphere, PyramidsTakeAllSolidAngleAndAllFlux) {
  for (const Cut& cut : Cuts()) {
    const Hemisphere hemisphere(cut.initial, cut.split, cut.depth);
    ASSERT_EQ(hemisphere.size(), cut.Pyramids()) << cut.Name();
    double solid_angle = 0, flux = 0;
    for (int p = 0; p < hemisphere.size(); ++p) {
      EXPECT_GT(hemisphere.pyramid(p).solid_angle(), 0);
      EXPECT_GT(hemisphere.pyramid(p).flux_fraction(), 0);
      solid_angle += hemisphere.pyramid(p).solid_angle();
      flux += hemisphere.pyramid(p).flux_fraction();
    }
    EXPECT_NEAR(solid_angle, 2 * kPi, 1e-11) << cut.Name();
    EXPECT_NEAR(flux, 1, 1e-12) << cut.Name();
  }
}

TEST(Hemisphere, InitialTrianglesAreEqual) {
  const Hemisphere hemisphere(5, 4, 0);
  for (int p = 0; p < 5; ++p) {
    EXPECT_NEAR(hemisphere.pyramid(p).solid_angle(), 2 * kPi / 5, 1e-14);
    EXPECT_NEAR(hemisphere.pyramid(p).flux_fraction(), 0.2, 1e-15);
  }
}

TEST(Hemisphere, SplitByThreeMeetsInTheCentroidByFourInTheMidpoints) {
  const Vec3 pole{0, 0, 1}, x{1, 0, 0}, y{0, 1, 0};
  const SphericalTriangle third = Hemisphere(4, 3, 1).pyramid(0);
  EXPECT_NEAR(Length(third.c() - Normalized(pole + x + y)), 0, 1e-15);
  const SphericalTriangle middle = Hemisphere(4, 4, 1).pyramid(3);
  EXPECT_NEAR(Length(middle.a() - Normalized(pole + x)), 0, 1e-15);
  EXPECT_NEAR(Length(middle.b() - Normalized(x + y)), 0, 1e-15);
  EXPECT_NEAR(Length(middle.c() - Normalized(y + pole)), 0, 1e-15);
}

// The planes of a pyramid's sides tell what is inside; Locate descends through other planes.
TEST(Hemisphere, LocateAgreesWithTheSidesOfThePyramid) {
  constexpr double kSlack = 1e-12;  // directions so near to a side may go to either
  for (const Cut& cut : Cuts()) {
    const Hemisphere hemisphere(cut.initial, cut.split, cut.depth);
    std::vector<SphereBin> bins;
    for (int p = 0; p < hemisphere.size(); ++p) bins.emplace_back(hemisphere.pyramid(p));
    TestRandom random(3);
    int outside = 0, shared = 0;
    for (int k = 0; k < 100000; ++k) {
      Vec3 d = random.Direction();
      d.z = std::abs(d.z);
      const int p = hemisphere.Locate(d * random.Uniform(1e-3, 1e3));
      ASSERT_TRUE(p >= 0 && p < hemisphere.size()) << cut.Name();
      outside += bins[p].Inside(d) < -kSlack;
      if (k % 100 > 0) continue;  // no other pyramid holds it
      for (int q = 0; q < hemisphere.size(); ++q) shared += q != p && bins[q].Inside(d) > kSlack;
    }
    EXPECT_EQ(outside, 0) << cut.Name();
    EXPECT_EQ(shared, 0) << cut.Name();
  }
}

TEST(Hemisphere, LocateTakesTheWholeHorizonAndNothingBelow) {
  for (const Cut& cut : Cuts()) {
    const Hemisphere hemisphere(cut.initial, cut.split, cut.depth);
    EXPECT_GE(hemisphere.Locate({0, 0, 1}), 0);
    for (int k = 0; k < 360; ++k) {
      const double angle = k * kPi / 180;
      const Vec3 rim{std::cos(angle), std::sin(angle), 0};
      const int p = hemisphere.Locate(rim);
      ASSERT_TRUE(p >= 0 && p < hemisphere.size());
      EXPECT_GE(SphereBin(hemisphere.pyramid(p)).Inside(rim), -1e-12) << cut.Name() << " " << k;
      EXPECT_EQ(hemisphere.Locate(rim + Vec3{0, 0, -1e-9}), -1);
    }
    EXPECT_EQ(hemisphere.Locate({0, 0, -1}), -1);
  }
}

TEST(Hemisphere, HoldsBallOnlyWhereEveryPointOfTheBallIsLocatedInThePyramid) {
  TestRandom random(4);
  const Hemisphere hemisphere(4, 4, 2);
  int held = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3 center = random.Direction() * random.Uniform(0.1, 10);
    const double radius = random.Uniform(0, 0.3) * Length(center);
    const int p = hemisphere.Locate(center);
    if (p < 0 || !hemisphere.HoldsBall(p, center, radius)) continue;
    ++held;
    for (int l = 0; l < 50; ++l) {
      ASSERT_EQ(hemisphere.Locate(center + radius * random.Direction()), p);
    }
  }
  EXPECT_GT(held, 1000);
}

TEST(Hemisphere, HoldsBallIsExactUpToItsMargin) {
  const Hemisphere hemisphere(4, 4, 0);
  const Vec3 center{3, 2, 5};  // the nearest side of the octant is y = 0
  EXPECT_TRUE(hemisphere.HoldsBall(0, center, 2 - 1e-7));
  EXPECT_FALSE(hemisphere.HoldsBall(0, center, 2 + 1e-7));
  EXPECT_FALSE(hemisphere.HoldsBall(1, center, 0.1));
  EXPECT_FALSE(hemisphere.HoldsBall(0, {0, 0, 0}, 0.1));
}

}  // namespace
}  // namespace lambert
