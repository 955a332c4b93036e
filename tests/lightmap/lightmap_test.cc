#include "radiosity/lightmap/lightmap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/output/smooth.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

struct Mapped {
  PatchSet patches;
  Atlas atlas;
  std::vector<TexelPage> pages;
  std::vector<TexelValues> values;  // not dilated
};

// The lightmap of patches whose irradiance is `irradiance_lx` at their corners [world metres].
template <typename Light>
Mapped Map(const Scene& scene, double density, const Light& irradiance_lx) {
  Mapped mapped;
  mapped.patches = PatchesOf(scene);
  mapped.atlas = *BuildAtlas(scene, mapped.patches, {density, kLargestPage});
  mapped.pages = FindTexels(scene, mapped.patches, mapped.atlas);
  std::vector<std::array<Rgb, 3>> corners;
  for (const auto& patch : mapped.patches.corners) {
    std::array<Rgb, 3> light;
    for (int k = 0; k < 3; ++k) light[k] = irradiance_lx(mapped.patches.origin + patch[k]);
    corners.push_back(light);
  }
  for (const TexelPage& page : mapped.pages) {
    mapped.values.push_back(TexelIrradiance(page, corners));
  }
  return mapped;
}

// What a viewer shows at a point of a page: linear between the four texels around it.
Rgb Sampled(const TexelPage& page, const TexelValues& values, Point2 at) {
  Rgb sum;
  const double x = at[0] - 0.5, y = at[1] - 0.5;
  for (int dy = 0; dy < 2; ++dy) {
    for (int dx = 0; dx < 2; ++dx) {
      const int u = static_cast<int>(std::floor(x)) + dx, v = static_cast<int>(std::floor(y)) + dy;
      const double weight = (1 - std::fabs(x - u)) * (1 - std::fabs(y - v));
      const auto& value = values[static_cast<size_t>(v) * page.width + u];
      sum = sum + Rgb{value[0], value[1], value[2]} * weight;
    }
  }
  return sum;
}

TEST(Lightmap, OfAFurnaceIsConstant) {
  Mapped mapped = Map(MakeFurnace(0.5, 1, 3), 30, [](Vec3) { return Rgb{2, 2, 2}; });
  Dilate(mapped.pages[0], mapped.values[0]);
  const TexelPage& page = mapped.pages[0];
  int surface = 0;
  for (size_t i = 0; i < page.texels.size(); ++i) {
    if (page.texels[i].patch == kNoPatch) continue;
    ++surface;
    EXPECT_FLOAT_EQ(mapped.values[0][i][0], 2);
    // And what stands around it, too.
    const size_t x = i % page.width, y = i / page.width;
    for (size_t v = y - kPadding; v <= y + kPadding; ++v) {
      for (size_t u = x - kPadding; u <= x + kPadding; ++u) {
        EXPECT_FLOAT_EQ(mapped.values[0][v * page.width + u][0], 2);
      }
    }
  }
  EXPECT_EQ(surface, 6 * 30 * 30);
}

// Two charts of one plane, because their edge has vertices of its own on each side.
TEST(Lightmap, ChartsThatMeetOnAPlaneAgreeAlongTheEdge) {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  const Scene scene = SceneMaker()
                          .Quad({}, {1, 0, 0}, {0, 0.7, 0}, gray, 5)
                          .Quad({1, 0, 0}, {1, 0, 0}, {0, 0.7, 0}, gray, 7)
                          .Make();
  constexpr double density = 40, slope = 3;  // lx a metre
  Mapped mapped = Map(scene, density, [](Vec3 p) { return Rgb{slope * p.x, 1 + slope * p.y, 1}; });
  Dilate(mapped.pages[0], mapped.values[0]);
  // Of the places at x = 1 on both sides.
  const auto seen_at = [&](const PlacedSurface& surface, double y) {
    Rgb value{-1, -1, -1};
    const Vec3 p = Vec3{1, y, 0} - mapped.patches.origin;
    for (int32_t t = surface.first; t < surface.first + surface.count; ++t) {
      const Vec3 w = WeightsAt(mapped.atlas.placed.triangles[t].corners, p);
      if (std::min({w.x, w.y, w.z}) < -1e-9) continue;
      const FlatTriangle& texel = mapped.atlas.front[t].texel;
      Point2 at;
      for (int axis = 0; axis < 2; ++axis) {
        at[axis] = w.x * texel[0][axis] + w.y * texel[1][axis] + w.z * texel[2][axis];
      }
      value = Sampled(mapped.pages[0], mapped.values[0], at);
    }
    return value;
  };
  for (double y = 0.013; y < 0.69; y += 0.029) {
    const Rgb left = seen_at(mapped.atlas.placed.surfaces[0], y);
    const Rgb right = seen_at(mapped.atlas.placed.surfaces[1], y);
    // Each stands off the edge by half a texel at most.
    EXPECT_NEAR(left.r, slope, slope / density / 2 * 1.001) << y;
    EXPECT_NEAR(right.r, slope, slope / density / 2 * 1.001) << y;
    EXPECT_NEAR(left.g, right.g, slope / density) << y;
  }
}

// E = I cos^3 / h^2 under a point light at height h.
TEST(Lightmap, OfAPlaneUnderAPointLightFallsAsTheCubeOfTheCosine) {
  const Scene scene =
      SceneMaker().Quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}, {{0.5, 0.5, 0.5}, {}}, 64).Make();
  constexpr double h = 1.5;
  const auto exact = [](Vec3 p) {
    const double cosine = h / Length(Vec3{p.x, h, p.z});
    return Rgb{100, 100, 100} * (cosine * cosine * cosine / (h * h));
  };
  const Mapped mapped = Map(scene, 50, exact);
  for (size_t i = 0; i < mapped.values[0].size(); ++i) {
    const Texel& texel = mapped.pages[0].texels[i];
    if (texel.patch == kNoPatch) continue;
    const double truth = exact(mapped.patches.origin + TexelPoint(mapped.patches, texel)).r;
    // Linear between corners 1/32 m apart: h^2 / 8 times the second derivative, under 100 lx/m2.
    EXPECT_NEAR(mapped.values[0][i][0], truth, 100 * (2.0 / 32 / 32) / 8);
  }
}

TEST(Lightmap, TexelsTooSmallForTheirCentresShowTheirSurface) {
  // 1 mm strips at 10 texels a metre: each is less than a texel, and still has one.
  const Scene scene = SceneMaker().Quad({}, {0.001, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  const Mapped mapped = Map(scene, 10, [](Vec3) { return Rgb{1, 1, 1}; });
  int count = 0;
  for (const Texel& texel : mapped.pages[0].texels) count += texel.patch != kNoPatch;
  EXPECT_GE(count, 2);
}

TEST(TexelReader, TexturesAreReadTexelByTexel) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};
  scene.textures = {texture};
  scene.materials[0].reflectance_texture.texture = 0;
  scene.materials[0].luminance = {1, 1, 1};
  scene.materials[0].luminance_texture.texture = 0;
  Primitive& primitive = scene.meshes[0].primitives[0];
  for (const auto& p : primitive.positions) primitive.uv[0].push_back({p[0], p[1]});
  const Mapped mapped = Map(scene, 16, [](Vec3) { return Rgb{1, 1, 1}; });
  const auto reader = TexelReader::Create(scene, mapped.patches, mapped.atlas);
  ASSERT_TRUE(reader.ok()) << reader.status();
  const TexelPage& page = mapped.pages[0];
  for (size_t i = 0; i < page.texels.size(); ++i) {
    if (page.texels[i].patch == kNoPatch) continue;
    const TexelSurface surface = reader->At(page, i);
    const bool is_white = TexelPoint(mapped.patches, page.texels[i]).x > 0;  // from the middle
    EXPECT_NEAR(surface.reflectance.r, is_white ? 0.5 : 0, 1e-6);
    EXPECT_NEAR(surface.exitance_lm_per_m2.r, is_white ? M_PI : 0, 1e-6);
  }
}

}  // namespace
}  // namespace lambert
