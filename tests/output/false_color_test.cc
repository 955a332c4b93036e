#include "radiosity/output/false_color.h"

#include <gtest/gtest.h>

#include "radiosity/output/exposure.h"

namespace lambert {
namespace {

Picture PictureOf(const std::vector<double>& irradiances_lx) {
  Picture picture;
  picture.width = static_cast<int>(irradiances_lx.size());
  picture.height = 1;
  for (double value : irradiances_lx) {
    picture.irradiance_lx.push_back({value, value, value});
    picture.display.push_back({0.5, 0.5, 0.5});
    picture.patch.push_back(0);
  }
  return picture;
}

TEST(LuxScale, EndsAtRoundNumbersAroundThePicture) {
  std::vector<double> values;
  for (int k = 0; k < 100; ++k) values.push_back(30 + 4 * k);
  const LuxScale scale = ChooseLuxScale(PictureOf(values));
  EXPECT_DOUBLE_EQ(scale.low_lx, 20);
  EXPECT_DOUBLE_EQ(scale.high_lx, 500);
  EXPECT_EQ(scale.Place(scale.low_lx), 0);
  EXPECT_EQ(scale.Place(scale.high_lx), 1);
  EXPECT_NEAR(scale.Place(100), 0.5, 1e-12);  // the geometric middle
}

TEST(LuxScale, SpansAtMostTwoDecadesAndAStep) {
  std::vector<double> values(50, 1e-9);
  values.resize(100, 1000);
  const LuxScale scale = ChooseLuxScale(PictureOf(values));
  EXPECT_GE(scale.low_lx, 1e3 / 100 / 2.5);
}

TEST(LuxScale, DarknessAndExtremesGiveAScaleToo) {
  EXPECT_GT(ChooseLuxScale(PictureOf({0, 0})).high_lx, 0);
  for (double value : {1e-300, 1e-30, 1.0, 1e30}) {
    const LuxScale scale = ChooseLuxScale(PictureOf({value, value}));
    EXPECT_LE(scale.low_lx, value);
    EXPECT_GE(scale.high_lx, value);
    EXPECT_LT(scale.low_lx, scale.high_lx);
  }
}

TEST(FalseColor, RunsFromBlueOverGreenToRed) {
  const Rgb low = FalseColor(0.1), middle = FalseColor(0.5), high = FalseColor(0.9);
  EXPECT_GT(low.b, low.r);
  EXPECT_GT(middle.g, middle.r);
  EXPECT_GT(middle.g, middle.b);
  EXPECT_GT(high.r, high.g);
  EXPECT_GT(high.r, high.b);
}

TEST(FalseColorPicture, LeavesTheBackgroundAlone) {
  Picture picture = PictureOf({1, 100});
  picture.patch[0] = kNoPatch;
  const std::vector<Rgb> colors = FalseColorPicture(picture, ChooseLuxScale(picture));
  EXPECT_EQ(colors[0], picture.display[0]);
  EXPECT_NE(colors[1], picture.display[1]);
}

}  // namespace
}  // namespace lambert
