#include "radiosity/shoot/light_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "radiosity/scene/sky_map.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kRays = 100000;

class LightRaysTest : public testing::Test {
 protected:
  // Calls use(origin, direction) for rays of the light, both in trace coordinates.
  template <typename Use>
  void ForRays(const Light& light, Use use) {
    const LightRays rays(light, BoundsOf(patches_), *scene_);
    auto batch = std::make_unique<RayBatch>();
    const auto weight = std::make_unique<Rgb[]>(RayBatch::kSlots);
    for (uint32_t ray = 0; ray < kRays; ray += RayBatch::kCapacity) {
      const uint32_t end = std::min<uint32_t>(kRays, ray + RayBatch::kCapacity);
      batch->size = 0;
      rays.Append(RandomStream{4, 99, 1, 2}, ray, end, *batch, weight.get());
      ASSERT_EQ(batch->size, static_cast<int>(end - ray));
      for (int k = 0; k < batch->size; ++k) {
        use(Vec3{batch->origin_x[k], batch->origin_y[k], batch->origin_z[k]},
            Vec3{batch->direction_x[k], batch->direction_y[k], batch->direction_z[k]});
      }
    }
  }

  const PatchSet patches_ = PatchesOf(SceneMaker().Box({}, {1, 2, 4}, true, {{}}).Make());
  const std::unique_ptr<RayScene> scene_ = *RayScene::Create(patches_);
};

TEST_F(LightRaysTest, OfAPointLightAreUniformOverTheSphere) {
  const Light light{"", {0.1, 0.2, 0.3}, {1, 1, 1}};
  const Vec3 place = scene_->ToTrace(light.position);
  std::vector<int64_t> counts(8 * 12);
  ForRays(light, [&](Vec3 origin, Vec3 d) {
    ASSERT_NEAR(Length(d), 1, 1e-6);
    ASSERT_NEAR(Length(origin - place), 0, 1e-7);
    // Archimedes: slices of equal height have equal area.
    const int slice = std::clamp(static_cast<int>((d.z + 1) * 4), 0, 7);
    const int sector = std::clamp(static_cast<int>((std::atan2(d.y, d.x) + kPi) * 6 / kPi), 0, 11);
    ++counts[slice * 12 + sector];
  });
  EXPECT_LT(ChiSquared(counts, std::vector<double>(96, 1.0 / 96)), ChiSquaredQuantile(95));
}

TEST_F(LightRaysTest, OfASpotFollowItsIntensityAroundItsAxis) {
  Light light{"", {}, {1, 1, 1}};
  light.x = {0, 0, 1};
  light.y = {1, 0, 0};
  light.z = {0, 1, 0};
  light.cos_inner = 0.8;
  light.cos_outer = 0.4;
  // Ten slices of the cosine, six sectors; Simpson's rule is exact for the square.
  const Cone cone(light.cos_inner, light.cos_outer);
  std::vector<double> expected;
  for (int slice = 0; slice < 12; ++slice) {
    const double low = 0.4 + 0.05 * slice, middle = low + 0.025, high = low + 0.05;
    const double part = 0.05 / 6 * (cone.Factor(low) + 4 * cone.Factor(middle) + cone.Factor(high));
    for (int k = 0; k < 6; ++k) expected.push_back(part * 2 * kPi / 6 / cone.SolidAngle());
  }
  std::vector<int64_t> counts(expected.size());
  ForRays(light, [&](Vec3, Vec3 d) {
    ASSERT_GE(d.y, 0.4 - 1e-6);
    const int slice = std::clamp(static_cast<int>((d.y - 0.4) / 0.05), 0, 11);
    const int sector = std::clamp(static_cast<int>((std::atan2(d.x, d.z) + kPi) * 3 / kPi), 0, 5);
    ++counts[slice * 6 + sector];
  });
  EXPECT_LT(ChiSquared(counts, expected), ChiSquaredQuantile(counts.size() - 1));
}

// Uniform over the beam: where it crosses the plane y = 0 of the box, rays are as many in each
// part.
TEST_F(LightRaysTest, OfADistantLightFillTheBeamThatTheBoxCatches) {
  Light light{"", {}, {1, 1, 1}, Light::Kind::kDistant};
  light.z = {0.6, -0.8, 0};
  const Bounds box = BoundsOf(patches_);
  const Vec3 low = scene_->ToTrace(box.low), high = scene_->ToTrace(box.high);
  // Seen along z, a corner of the box shadows the floor's plane over 1 m + 2 m * .6 / .8.
  const double shadow = 2.5 / 1.0 * (high.x - low.x);
  std::vector<int64_t> counts(10 * 8);
  ForRays(light, [&](Vec3 origin, Vec3 d) {
    ASSERT_NEAR(Length(d - light.z), 0, 1e-6);
    const bool outside = origin.x < low.x || origin.y > high.y;
    ASSERT_TRUE(outside);
    const Vec3 floor = origin + d * ((low.y - origin.y) / d.y);
    const int along = static_cast<int>(std::floor((floor.x - low.x) / shadow * 10));
    const int across = static_cast<int>(std::floor((floor.z - low.z) / (high.z - low.z) * 8));
    ++counts[std::clamp(along, 0, 9) * 8 + std::clamp(across, 0, 7)];
  });
  EXPECT_LT(ChiSquared(counts, std::vector<double>(80, 1.0 / 80)), ChiSquaredQuantile(79));
}

// A quarter of the light goes to the lower half of the table, evenly in each.
TEST_F(LightRaysTest, OfALampFollowItsTableAroundItsAxes) {
  Light light{"", {0.1, 0.2, 0.3}, {1, 1, 1}, Light::Kind::kLamp};
  light.x = {0, 0, 1};
  light.y = {1, 0, 0};
  light.z = {0, 1, 0};
  light.table = *SphereTable::Create({false, 1, {-1, 0, 1}, {0, 1}, {1, 3}});
  const Vec3 place = scene_->ToTrace(light.position);
  std::vector<double> expected;
  for (int slice = 0; slice < 8; ++slice) {
    for (int k = 0; k < 6; ++k) expected.push_back((slice < 4 ? 0.25 : 0.75) / 24);
  }
  std::vector<int64_t> counts(expected.size());
  ForRays(light, [&](Vec3 origin, Vec3 d) {
    ASSERT_NEAR(Length(origin - place), 0, 1e-7);
    const int slice = std::clamp(static_cast<int>((d.y + 1) * 4), 0, 7);
    const int sector = std::clamp(static_cast<int>((std::atan2(d.x, d.z) + kPi) * 3 / kPi), 0, 5);
    ++counts[slice * 6 + sector];
  });
  EXPECT_LT(ChiSquared(counts, expected), ChiSquaredQuantile(counts.size() - 1));
}

// Of each direction the rays are even over the disk that hides the sphere around the box.
TEST_F(LightRaysTest, OfASkyComeFromAboveAndFillTheDiskBeforeTheScene) {
  Light light{"", {}, {1, 1, 1}, Light::Kind::kSky};
  light.x = kSkyX;
  light.y = kSkyY;
  light.z = kSkyZ;
  light.table = UniformSky();
  const Bounds box = BoundsOf(patches_);
  const Vec3 center = scene_->ToTrace(box.Center());
  const double radius = box.Diagonal() / 2 * scene_->scale();
  std::vector<int64_t> counts(8 * 10);
  ForRays(light, [&](Vec3 origin, Vec3 d) {
    const Vec3 from = origin - center;
    ASSERT_LT(Dot(from, d), -radius);
    const Vec3 across = from - d * Dot(from, d);
    const double part = Dot(across, across) / (radius * radius);
    ASSERT_LT(part, 1 + 1e-5);
    const int slice = std::clamp(static_cast<int>(-d.y * 8), 0, 7);
    ++counts[slice * 10 + std::clamp(static_cast<int>(part * 10), 0, 9)];
  });
  EXPECT_LT(ChiSquared(counts, std::vector<double>(80, 1.0 / 80)), ChiSquaredQuantile(79));
}

}  // namespace
}  // namespace lambert
