#include "radiosity/lightmap/atlas.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/lightmap/atlas_part.h"
#include "radiosity/lightmap/lightmap.h"
#include "radiosity/patch/place.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

Atlas AtlasOf(const Scene& scene, const PatchSet& patches, double texels_per_meter = 0) {
  absl::StatusOr<Atlas> atlas = BuildAtlas(scene, patches, {texels_per_meter, 4096});
  EXPECT_TRUE(atlas.ok()) << atlas.status();
  return *std::move(atlas);
}

int32_t ChartOf(const Atlas& atlas, const PatchSet& patches, const Texel& texel) {
  return (patches.is_back[texel.patch] ? atlas.back : atlas.front)[texel.triangle].chart;
}

TEST(BuildAtlas, TexelsOfTwoChartsAreAtLeastThePaddingApart) {
  const Scene scene = MakeCornell(2);
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 20);
  for (const TexelPage& page : FindTexels(scene, patches, atlas)) {
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) {
        const Texel& here = page.texels[static_cast<size_t>(y) * page.width + x];
        if (here.patch == kNoPatch) continue;
        for (int v = y; v <= std::min(y + kPadding, page.height - 1); ++v) {
          for (int u = std::max(x - kPadding, 0); u <= std::min(x + kPadding, page.width - 1);
               ++u) {
            const Texel& near = page.texels[static_cast<size_t>(v) * page.width + u];
            if (near.patch == kNoPatch) continue;
            ASSERT_EQ(ChartOf(atlas, patches, near), ChartOf(atlas, patches, here));
          }
        }
      }
    }
  }
}

TEST(BuildAtlas, ItHasTheDensityThatIsAskedFor) {
  const Scene scene = SceneMaker().Quad({}, {2, 0, 0}, {0, 3, 0}, {{0.5, 0.5, 0.5}, {}}, 3).Make();
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 10);
  EXPECT_EQ(atlas.texels_per_meter, 10);
  int count = 0;
  const std::vector<TexelPage> pages = FindTexels(scene, patches, atlas);
  for (const Texel& texel : pages[0].texels) {
    count += texel.patch != kNoPatch;
  }
  EXPECT_EQ(count, 20 * 30);
}

TEST(BuildAtlas, TheDefaultDensityFollowsTheSize) {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  const Scene small = SceneMaker().Quad({}, {2, 0, 0}, {0, 3, 0}, gray).Make();
  EXPECT_EQ(AtlasOf(small, PatchesOf(small)).texels_per_meter, kDefaultDensity);
  const Scene large = SceneMaker().Quad({}, {200, 0, 0}, {0, 300, 0}, gray).Make();
  EXPECT_NEAR(AtlasOf(large, PatchesOf(large)).texels_per_meter, std::sqrt(kDefaultTexels / 6e4),
              1e-9);
}

TEST(BuildAtlas, ADensityBeyondThePagesIsReducedWithAWarning) {
  const Scene scene = MakeCornell();
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 1e5);
  EXPECT_LT(atlas.texels_per_meter, 1e5);
  ASSERT_EQ(atlas.warnings.size(), 1u);
  EXPECT_EQ(atlas.warnings[0].reason, "LIGHTMAP_REDUCED");
  EXPECT_LE(atlas.pages.size(), static_cast<size_t>(kMostPages));
}

TEST(BuildAtlas, InstancesOfOneMeshHaveRegionsOfTheirOwn) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Instance second = scene.instances[0];
  second.world.translation = {5, 0, 0};
  scene.instances.push_back(second);  // of the same node: told apart by where the patches are
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 8);
  ASSERT_EQ(atlas.placed.surfaces.size(), 2u);
  int count[2] = {0, 0};
  const std::vector<TexelPage> pages = FindTexels(scene, patches, atlas);
  for (const Texel& texel : pages[0].texels) {
    if (texel.patch == kNoPatch) continue;
    const bool is_second = TexelPoint(patches, texel).x + patches.origin.x > 3;
    EXPECT_EQ(texel.triangle >= atlas.placed.surfaces[1].first, is_second);
    ++count[is_second];
  }
  EXPECT_EQ(count[0], 64);
  EXPECT_EQ(count[1], 64);
}

TEST(BuildAtlas, UniqueCoordinatesAreKept) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Primitive& primitive = scene.meshes[0].primitives[0];
  for (const auto& p : primitive.positions) {
    primitive.uv[0].push_back({2 * p[0], 2 * p[1]});  // repeats
    primitive.uv[1].push_back({p[0] / 2, (p[1] + p[0] / 2) / 2});
  }
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 16);
  EXPECT_EQ(atlas.kept_uv[0], 1);
  primitive.uv[0] = primitive.uv[1];
  primitive.uv.erase(1);
  EXPECT_EQ(AtlasOf(scene, patches, 16).kept_uv[0], 0);
  primitive.uv.erase(0);
  EXPECT_EQ(AtlasOf(scene, patches, 16).kept_uv[0], -1);
}

TEST(BuildAtlas, BacksHaveRegionsWhereThereAreAny) {
  Paint paint{{0.5, 0.5, 0.5}, {}};
  paint.two_sided = true;
  const Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, paint).Make();
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 8);
  int count[2] = {0, 0};
  const std::vector<TexelPage> pages = FindTexels(scene, patches, atlas);
  for (const Texel& texel : pages[0].texels) {
    if (texel.patch != kNoPatch) ++count[patches.is_back[texel.patch]];
  }
  EXPECT_EQ(count[0], 64);
  EXPECT_EQ(count[1], 64);
}

TEST(SourcesExist, APatchThatNoInstanceShowsIsFound) {
  const Scene scene = MakeCornell();
  PatchSet patches = PatchesOf(scene);
  EXPECT_TRUE(SourcesExist(scene, patches));
  for (const PatchSource& wrong : {PatchSource{999, 0, 0, 0}, PatchSource{0, 0, 7, 0},
                                   PatchSource{0, 0, 0, 99}, PatchSource{0, 0, 0, -1}}) {
    patches.source[3] = wrong;
    EXPECT_FALSE(SourcesExist(scene, patches));
  }
}

TEST(SourcesExist, AMeshInAPoseOfItsOwnIsNamedAsInTheFile) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Mesh posed = scene.meshes[0];
  posed.pose_of = 0;
  scene.meshes[0].primitives.clear();  // as those of a mesh that is shown in poses alone
  scene.instances[0].mesh = 1;
  scene.meshes.push_back(posed);
  const PatchSet patches = PatchesOf(scene);
  EXPECT_EQ(FileMeshOf(scene, scene.instances[0]), 0);
  EXPECT_EQ(patches.source[0].mesh, 0);
  ASSERT_TRUE(SourcesExist(scene, patches));
  EXPECT_EQ(FindTriangles(scene, PlaceScene(scene, patches.origin), patches).size(),
            patches.corners.size());
}

TEST(FindTriangles, PatchesAreOfTheInstanceThatTheyLieIn) {
  Scene scene = SceneMaker().Box({}, {1, 1, 1}, false, {{{0.5, 0.5, 0.5}, {}}}).Make();
  const Instance one = scene.instances[0];
  for (int i = 1; i < 100; ++i) {  // turned, near each other, in no common plane
    Instance turned = one;
    turned.world.x = {std::cos(i), 0, -std::sin(i)};
    turned.world.z = {std::sin(i), 0, std::cos(i)};
    turned.world.translation = {0.9 * (i % 10), 0.8 * (i / 10) + 0.013 * i, 0.1 * (i % 7)};
    scene.instances.push_back(turned);
  }
  PatchOptions options;
  options.max_edge_m = 0.8;
  const PatchSet patches = *BuildPatches(scene, options);
  const PlacedScene placed = PlaceScene(scene, patches.origin);
  const std::vector<int32_t> found = FindTriangles(scene, placed, patches);
  ASSERT_EQ(found.size(), 100u * 12 * 4);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const SurfaceTriangle& triangle = placed.triangles[found[i]];
    for (const Vec3& corner : patches.corners[i]) {
      const Vec3 w = WeightsAt(triangle.corners, corner);
      const auto& [a, b, c] = triangle.corners;
      EXPECT_LT(Length(a * w.x + b * w.y + c * w.z - corner), 1e-9);
      EXPECT_GT(std::min({w.x, w.y, w.z}), -1e-9);
    }
  }
}

TEST(PartsOf, EachPartHasTheTrianglesOfItsSide) {
  Paint paint{{0.5, 0.5, 0.5}, {}};
  paint.two_sided = true;
  const Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, paint, 2).Make();
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = AtlasOf(scene, patches, 8);
  const std::vector<AtlasPart> parts = PartsOf(atlas, SidesWithPatches(scene, patches, atlas));
  ASSERT_EQ(parts.size(), 2u);
  for (const AtlasPart& part : parts) {
    EXPECT_EQ(part.triangles.size(), 8u);
    EXPECT_EQ(part.source.size(), 9u);
    for (const auto& [a, b, c] : part.triangles) {
      const auto& p = part.position_m;
      EXPECT_EQ(Cross(p[b] - p[a], p[c] - p[a]).z > 0, !part.is_back);
    }
    for (const auto& [u, v] : part.uv) EXPECT_TRUE(u > 0 && u < 1 && v > 0 && v < 1);
  }
}

TEST(BuildAtlas, MoreChartsThanTexelsAreRefused) {
  // Each of these 100 squares takes 5 x 5 texels at any density.
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Primitive& primitive = scene.meshes[0].primitives[0];
  const Primitive square = primitive;
  for (uint32_t i = 1; i < 100; ++i) {
    for (auto p : square.positions) {
      primitive.positions.push_back({p[0] + 2.0f * static_cast<float>(i), p[1], p[2]});
    }
    for (auto t : square.triangles) {
      const auto base = static_cast<uint32_t>(square.positions.size() * i);
      primitive.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
    }
  }
  const PatchSet patches = PatchesOf(scene);
  const auto atlas = BuildAtlas(scene, patches, {0, 16});
  EXPECT_EQ(ReasonOf(atlas.status()), "LIGHTMAP_TOO_LARGE");
}

}  // namespace
}  // namespace lambert
