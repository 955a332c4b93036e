#include <gtest/gtest.h>

#include <limits>

#include "radiosity/core/rgb.h"
#include "radiosity/core/transform.h"
#include "radiosity/core/vec3.h"

namespace lambert {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Vec3, CrossIsOrthogonalAndRightHanded) {
  const Vec3 a{1, 2, 3}, b{-2, 0.5, 4};
  const Vec3 c = Cross(a, b);
  EXPECT_EQ(Dot(a, c), 0);
  EXPECT_EQ(Dot(b, c), 0);
  EXPECT_EQ(Cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(Cross(b, a), -c);
}

TEST(Vec3, LengthNeitherOverflowsNorUnderflows) {
  EXPECT_EQ(Length({3, 4, 0}), 5);
  EXPECT_DOUBLE_EQ(Length({3e200, 4e200, 0}), 5e200);
  EXPECT_DOUBLE_EQ(Length({3e-200, 0, 4e-200}), 5e-200);
  EXPECT_NEAR(Length(Normalized({1e-180, 2e-180, -3e-180})), 1, 1e-15);
}

TEST(Vec3, ArithmeticIsComponentwise) {
  const Vec3 a{1, 2, 3}, b{4, 6, 8};
  EXPECT_EQ(a + b, (Vec3{5, 8, 11}));
  EXPECT_EQ(b - a, (Vec3{3, 4, 5}));
  EXPECT_EQ(2 * a, a * 2);
  EXPECT_EQ(b / 2, (Vec3{2, 3, 4}));
}

TEST(Finiteness, OneBadComponentIsEnough) {
  EXPECT_TRUE(IsFinite(Vec3{1, 2, 3}));
  EXPECT_FALSE(IsFinite(Vec3{kNan, 2, 3}));
  EXPECT_FALSE(IsFinite(Vec3{1, kInfinity, 3}));
  EXPECT_FALSE(IsFinite(Vec3{1, 2, -kInfinity}));
  EXPECT_TRUE(IsFinite(Rgb{1, 2, 3}));
  EXPECT_FALSE(IsFinite(Rgb{kNan, 2, 3}));
  EXPECT_FALSE(IsFinite(Rgb{1, kInfinity, 3}));
  EXPECT_FALSE(IsFinite(Rgb{1, 2, kNan}));
}

TEST(Rgb, IndexesItsChannelsInOrder) {
  Rgb a{1, 2, 3};
  for (int c = 0; c < 3; ++c) EXPECT_EQ(static_cast<const Rgb&>(a)[c], c + 1);
  a[1] = 7;
  EXPECT_EQ(a, (Rgb{1, 7, 3}));
  EXPECT_EQ(Mean({1, 2, 6}), 3);
  EXPECT_EQ(((Rgb{1, 2, 3} + Rgb{1, 1, 1}) * Rgb{2, 3, 4} - Rgb{4, 9, 16}), Rgb());
  EXPECT_EQ((Rgb{2, 4, 6} * 0.5), (Rgb{4, 8, 12} / 4));
}

TEST(Transform, ProductAppliesTheSecondFirst) {
  const Transform turn{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {10, 0, 0}};  // x to y, then along x
  const Transform shift{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 2, 3}};
  const Vec3 p{5, 6, 7};
  EXPECT_EQ((turn * shift).Point(p), turn.Point(shift.Point(p)));
  EXPECT_EQ((turn * shift).Point(p), (Vec3{2, 6, 10}));
  EXPECT_EQ((turn * shift).Vector(p), turn.Vector(p));  // translations do not move directions
}

TEST(Transform, DeterminantIsNegativeWhereItMirrors) {
  const Transform stretch{{2, 0, 0}, {0, 3, 0}, {0, 0, 4}, {}};
  const Transform mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
  EXPECT_EQ(Transform().Determinant(), 1);
  EXPECT_EQ(stretch.Determinant(), 24);
  EXPECT_EQ((stretch * mirror).Determinant(), -24);
}

}  // namespace
}  // namespace lambert
