// Pictures and corners in gathered light.
#include "radiosity/output/gathered_light.h"

#include <gtest/gtest.h>

#include <memory>

#include "radiosity/gather/gather.h"
#include "radiosity/output/picture.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

struct Lit {
  std::shared_ptr<const PatchSet> patches;
  std::unique_ptr<RayScene> scene;
  CornerFans fans;
  std::vector<std::array<Vec3, 3>> normals;
  Solution solution;

  explicit Lit(const Scene& of, Rgb radiosity)
      : patches(std::make_shared<const PatchSet>(PatchesOf(of))),
        scene(*RayScene::Create(*patches)),
        fans(FindCornerFans(*patches, *scene)),
        normals(SmoothNormals(*patches, fans)) {
    solution.radiosity_lm_per_m2.assign(patches->size(), radiosity);
    solution.irradiance_lx.assign(patches->size(), {});
    solution.std_error_lm_per_m2.assign(patches->size(), {});
  }
  GatherFunction Gather(int rays) const {
    return *GatherHere(patches, solution.radiosity_lm_per_m2, {rays, 1});
  }
};

TEST(GatheredLight, OfAFurnaceIsTheSameAtEveryCorner) {
  const Lit lit(MakeFurnace(0.5, 1, 2), {2, 2, 2});
  const auto corners = *GatherCorners(*lit.patches, lit.fans, lit.normals, lit.Gather(1024));
  for (const auto& patch : corners) {
    for (const Rgb& irradiance : patch) EXPECT_NEAR(irradiance.g, 2, 0.2);
  }
}

TEST(GatheredLight, AShadowIsSharperThanThePatches) {
  // A screen half a metre over a floor of one square, a small lamp far above.
  SceneMaker maker;
  const Paint gray{{0.5, 0.5, 0.5}, {0, 0, 0}};
  maker.Quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, gray).Quad({0, 0.5, 0}, {0, 0, 4}, {2, 0, 0}, gray);
  maker.Quad({1.95, 8, 1.95}, {0.1, 0, 0}, {0, 0, 0.1}, {{0, 0, 0}, {1e5, 1e5, 1e5}});
  maker.LookFrom({5, 6, 2}, {2, 0, 2}, 0.8);
  Lit lit(maker.Make(), {});
  lit.solution.radiosity_lm_per_m2 = lit.patches->exitance_lm_per_m2;
  const View view = ChooseView(*lit.patches, *lit.scene, lit.solution.radiosity_lm_per_m2);
  const auto corners = *GatherCorners(*lit.patches, lit.fans, lit.normals, lit.Gather(64));
  const auto picture =
      *DrawGatheredPicture(view, *lit.patches, *lit.scene, lit.solution, {*lit.patches, nullptr},
                           corners, lit.normals, lit.Gather(64), 120);
  // Each pixel of the floor is in full light, in the dark, or in a narrow penumbra.
  int dark = 0, bright = 0, between = 0;
  for (size_t pixel = 0; pixel < picture.patch.size(); ++pixel) {
    const PatchIndex patch = picture.patch[pixel];
    if (patch == kNoPatch || PatchCentroid(*lit.patches, patch).y + lit.patches->origin.y > 0.1) {
      continue;
    }
    const double lx = picture.irradiance_lx[pixel].g;
    (lx < 0.1 ? dark : lx > 3 ? bright : between) += 1;
  }
  EXPECT_GT(bright, 500);
  EXPECT_LT(between, 0.1 * bright);
}

TEST(GatheredLight, NormalsOfAFlatFanAreItsOwnAndOfASphereItsRadii) {
  const Lit lit(MakeIcosphere(2, {{0.5, 0.5, 0.5}, {1, 1, 1}}), {2, 2, 2});
  for (PatchIndex i = 0; i < lit.patches->size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 at = Normalized(lit.patches->corners[i][corner] + lit.patches->origin);
      EXPECT_LT(Dot(lit.normals[i][corner], at), -0.99);
    }
  }
}

TEST(GatheredLight, FailsAsItsGatherDoes) {
  const Lit lit(MakeFurnace(0.5, 1, 1), {2, 2, 2});
  const GatherFunction fails = [](const GatherPoints&) { return absl::AbortedError("no"); };
  EXPECT_FALSE(GatherCorners(*lit.patches, lit.fans, lit.normals, fails).ok());
  const View view = ChooseView(*lit.patches, *lit.scene, lit.solution.radiosity_lm_per_m2);
  const std::vector<std::array<Rgb, 3>> corners(lit.patches->size());
  EXPECT_FALSE(DrawGatheredPicture(view, *lit.patches, *lit.scene, lit.solution,
                                   {*lit.patches, nullptr}, corners, lit.normals, fails, 40)
                   .ok());
}

}  // namespace
}  // namespace lambert
