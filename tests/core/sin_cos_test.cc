#include "radiosity/core/sin_cos.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(SinCos, EqualsTheStandardLibraryWithinItsErrorOverTheCircle) {
  double worst = 0;
  constexpr int kSteps = 200000;
  for (int k = -kSteps; k <= kSteps; ++k) {
    const double x = kPi * k / kSteps;
    const SineCosine at = SinCos(x);
    worst = std::max({worst, std::abs(at.sine - std::sin(x)), std::abs(at.cosine - std::cos(x))});
  }
  EXPECT_LT(worst, 1e-14);
  EXPECT_EQ(SinCos(0.0).sine, 0);
  EXPECT_EQ(SinCos(0.0).cosine, 1);
}

}  // namespace
}  // namespace lambert
