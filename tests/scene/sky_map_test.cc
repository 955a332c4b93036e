#include "radiosity/scene/sky_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

Rgb Toward(const SphereTable& sky, Vec3 d) {
  d = Normalized(d);
  return sky.Value({Dot(d, kSkyX), Dot(d, kSkyY), Dot(d, kSkyZ)});
}

TEST(SkyMap, RowsFallFromTheZenithAndTheMiddleLooksAlongX) {
  SkyMap sky{4, 2, {}};
  for (int k = 0; k < 8; ++k) sky.rgb.insert(sky.rgb.end(), {k + 1.0f, 0, 1});
  const std::string bytes = EncodeSkyMap(sky);
  ASSERT_TRUE(IsSkyMap(bytes));
  const auto table = DecodeSkyMap("sky.exr", bytes);
  ASSERT_TRUE(table.ok()) << table.status();
  EXPECT_EQ(Toward(**table, {1, 1, 0.1}), (Rgb{3, 0, 1}));
  EXPECT_EQ(Toward(**table, {1, 1, -0.1}), (Rgb{2, 0, 1}));
  EXPECT_EQ(Toward(**table, {-1, 1, 0.1}), (Rgb{4, 0, 1}));
  EXPECT_EQ(Toward(**table, {1, -1, 0.1}), (Rgb{7, 0, 1}));
  EXPECT_EQ(Toward(**table, {0.1, -1, -1}), (Rgb{6, 0, 1}));
  EXPECT_NEAR((*table)->total().b, 4 * kPi, 1e-9);
  EXPECT_NEAR((*table)->CosineTotal().b, kPi, 1e-9);
}

TEST(SkyMap, AFittingSkySendsAsMuchAsTheLargeOne) {
  SkyMap large{4096, 1024, {}};
  double sum = 0;
  for (int row = 0; row < large.height; ++row) {
    const double angle =
        std::cos(kPi * row / large.height) - std::cos(kPi * (row + 1) / large.height);
    for (int column = 0; column < large.width; ++column) {
      const float value = static_cast<float>((row * 31 + column * 17) % 101);
      large.rgb.insert(large.rgb.end(), {value, 1, 0});
      sum += angle * value;
    }
  }
  const SkyMap fitting = FittingSky(large);
  EXPECT_EQ(fitting.width, 2048);
  EXPECT_EQ(fitting.height, 512);
  const auto table = DecodeSkyMap("sky.exr", EncodeSkyMap(fitting));
  ASSERT_TRUE(table.ok()) << table.status();
  EXPECT_NEAR((*table)->total().r / (sum * 2 * kPi / large.width), 1, 1e-6);
  EXPECT_NEAR((*table)->total().g, 4 * kPi, 1e-5);
  EXPECT_EQ(FittingSky(fitting).rgb, fitting.rgb);
}

TEST(SkyMap, BytesThatAreNoneAreRefused) {
  const std::string good = EncodeSkyMap({2, 1, {1, 1, 1, 2, 2, 2}});
  const auto refused = [](const std::string& bytes) {
    return ReasonOf(DecodeSkyMap("sky.exr", bytes).status()) == "SCENE_INVALID";
  };
  EXPECT_FALSE(refused(good));
  for (size_t length = 0; length < good.size(); ++length) {
    ASSERT_TRUE(refused(good.substr(0, length))) << length;
  }
  std::string bad = good;
  bad[8] = 0;  // no width
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad[11] = 0x7f;  // a width of billions
  EXPECT_TRUE(refused(bad));
  EXPECT_TRUE(refused(EncodeSkyMap({2, 1, {1, -1, 1, 2, 2, 2}})));
  EXPECT_TRUE(refused(EncodeSkyMap({2, 1, {1, INFINITY, 1, 2, 2, 2}})));
}

TEST(SkyMap, SkiesOfTheStandardsComeFromAbove) {
  EXPECT_EQ(Toward(*UniformSky(), {0.3, 0.1, 0.5}).r, 1);
  EXPECT_EQ(Toward(*UniformSky(), {0.3, -0.1, 0.5}).r, 0);
  EXPECT_NEAR(Toward(*OvercastSky(), {0, 1, 0}).r, 3, 1e-12);
  EXPECT_NEAR(Toward(*OvercastSky(), {0.8, 0.6, 0}).r, 1 + 2 * 0.6, 1e-12);
}

}  // namespace
}  // namespace lambert
