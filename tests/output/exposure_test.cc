#include "radiosity/output/exposure.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace lambert {
namespace {

Rgb Gray(double value) { return {value, value, value}; }

TEST(ChooseExposure, DoesNotDependOnTheUnitOfLight) {
  for (double scale : {1e-30, 1.0, 1e30}) {
    const Exposure exposure =
        ChooseExposure({Gray(1 * scale), Gray(2 * scale), Gray(4 * scale)}, {});
    const double middle = Develop(Gray(2 * scale), exposure).g;
    EXPECT_GT(middle, 0.15);
    EXPECT_LT(middle, 0.5);
  }
}

TEST(ChooseExposure, LampsInThePictureDoNotDarkenIt) {
  const std::vector<Rgb> reflected(100, Gray(3));
  std::vector<Rgb> emitted(100);
  const Exposure without = ChooseExposure(reflected, emitted);
  emitted[5] = Gray(1e6);
  EXPECT_EQ(ChooseExposure(reflected, emitted).per_lm_per_m2, without.per_lm_per_m2);
}

TEST(ChooseExposure, UnlitPartsDoNotBrightenIt) {
  std::vector<Rgb> reflected(100, Gray(3));
  const Exposure full = ChooseExposure(reflected, reflected);
  for (int k = 0; k < 50; ++k) reflected[k] = {};
  EXPECT_NEAR(ChooseExposure(reflected, reflected).per_lm_per_m2, full.per_lm_per_m2, 1e-12);
}

TEST(ChooseExposure, WhereNothingReflectsTheEmittersDecide) {
  EXPECT_DOUBLE_EQ(ChooseExposure({{}, {}}, {Gray(10), {}}).per_lm_per_m2, 0.08);
}

TEST(ChooseExposure, DarknessIsExposedByOne) {
  EXPECT_EQ(ChooseExposure({{}, {}}, {{}, {}}).per_lm_per_m2, 1);
}

TEST(Develop, IsLinearUpToTheRollOff) {
  const Rgb value = Develop({0.1, 0.4, 0.8}, {1});
  EXPECT_EQ(value, (Rgb{0.1, 0.4, 0.8}));
}

TEST(Develop, LinearCutsOffAtWhite) {
  const Exposure linear{2, ToneMap::kLinear};
  EXPECT_EQ(Develop({0.1, 0.45, 0.5}, linear), (Rgb{0.2, 0.9, 1}));
  EXPECT_EQ(Develop({0.25, 3, 1e300}, linear), (Rgb{0.5, 1, 1}));
}

TEST(ExposureValue, IsThatOfCameras) {
  // At EV 0 a luminance of 1.2 cd/m2 is white; each EV halves the exposure.
  EXPECT_NEAR(Develop(Gray(1.2 * std::numbers::pi), {ExposureOfEv100(0), ToneMap::kLinear}).g, 1,
              1e-15);
  EXPECT_DOUBLE_EQ(ExposureOfEv100(5), ExposureOfEv100(4) / 2);
  for (double ev100 : {-100.0, -3.25, 15.0, 100.0}) {
    EXPECT_NEAR(Ev100Of(ExposureOfEv100(ev100)), ev100, 1e-12);
  }
}

TEST(Develop, IsContinuousAndRisesToWhite) {
  double last = 0.0099;
  for (double value = 0.01; value < 1e4; value *= 1.02) {
    const double shown = Develop({value, value, value}, {1}).g;
    EXPECT_GT(shown, last);
    EXPECT_LE(shown - last, 0.02 * value + 1e-12);
    EXPECT_LE(shown, 1);
    last = shown;
  }
  EXPECT_GT(last, 0.999);
}

TEST(Develop, StaysInRangeForAnything) {
  for (double value : {0.0, 1e-320, 1e30, 1e300, std::numeric_limits<double>::max()}) {
    for (double exposure : {1e-300, 1.0, 1e300}) {
      const Rgb shown = Develop({value, 0, value / 2}, {exposure});
      for (int channel = 0; channel < 3; ++channel) {
        EXPECT_GE(shown[channel], 0);
        EXPECT_LE(shown[channel], 1);
      }
    }
  }
}

TEST(SrgbByte, HitsTheKnownPointsOfTheCurve) {
  EXPECT_EQ(SrgbByte(0), 0);
  EXPECT_EQ(SrgbByte(1), 255);
  EXPECT_EQ(SrgbByte(7), 255);
  EXPECT_EQ(SrgbByte(0.21404114), 128 - 1);  // sRGB .5 = 127.5, a hair under
}

TEST(SrgbByte, IsTheRoundedCurve) {
  for (int k = 0; k <= 100'000; ++k) {
    const double x = k * 1e-5;
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    ASSERT_EQ(SrgbByte(x), std::lround(255 * encoded)) << x;
  }
}

TEST(Luminance, OfWhiteIsItsValue) { EXPECT_DOUBLE_EQ(Luminance(Gray(3)), 3); }

}  // namespace
}  // namespace lambert
