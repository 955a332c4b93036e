#include "radiosity/patch/cone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

// All around, a sharp and a soft spot, one that is nowhere whole, one of a single rim.
std::vector<Cone> Cones() { return {{-1, -1}, {0.9, 0.9}, {0.9, 0.5}, {1.2, 0.995}, {1, 0}}; }

// Integral of the factor over [cosine, 1], by Simpson's rule on 2^14 parts.
double Above(const Cone& cone, double cosine) {
  constexpr int kParts = 1 << 14;
  const double step = (1 - cosine) / kParts;
  double sum = 0;
  for (int k = 0; k < kParts; ++k) {
    const double z = cosine + k * step;
    sum += step / 6 * (cone.Factor(z) + 4 * cone.Factor(z + step / 2) + cone.Factor(z + step));
  }
  return sum;
}

TEST(Cone, ItsSolidAngleIsTheIntegralOfItsFactor) {
  EXPECT_EQ(Cone(-1, -1).SolidAngle(), 4 * kPi);
  for (const Cone& cone : Cones()) {
    EXPECT_NEAR(cone.SolidAngle() / (2 * kPi * Above(cone, -1)), 1, 1e-3);
  }
}

TEST(Cone, FallsBySquaresOverItsRim) {
  const Cone cone(0.9, 0.5);
  EXPECT_EQ(cone.Factor(0.95), 1);
  EXPECT_EQ(cone.Factor(0.9), 1);
  EXPECT_DOUBLE_EQ(cone.Factor(0.7), 0.25);
  EXPECT_EQ(cone.Factor(0.5), 0);
  EXPECT_EQ(cone.Factor(-1), 0);
}

// The inverse of the distribution: as much lies above the sample as its number says.
TEST(Cone, SamplesFollowTheFactor) {
  for (const Cone& cone : Cones()) {
    const double whole = cone.SolidAngle() / (2 * kPi);
    for (int k = 0; k <= 64; ++k) {
      const double u = k == 64 ? 1 - 0x1p-24 : k / 64.0, cosine = cone.SampleCosine(u);
      ASSERT_NEAR(Above(cone, cosine) / whole, u, 2e-4);
      ASSERT_LE(cosine, 1);
      ASSERT_GE(cosine, -1);
    }
  }
}

}  // namespace
}  // namespace lambert
