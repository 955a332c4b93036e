#include "radiosity/patch/surface_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// Furniture, walls and lamps, cut finely; blocks that are turned; a sphere.
std::vector<PatchSet> Scenes() {
  return {PatchesOf(MakeOffice(3)), PatchesOf(MakeCornell(6)),
          PatchesOf(MakeIcosphere(3, {{0.5, 0.5, 0.5}, {}, false}))};
}

TEST(SurfaceTree, HoldsEveryPatchOnce) {
  for (const PatchSet& patches : Scenes()) {
    const SurfaceTree tree(patches);
    std::vector<PatchIndex> order = tree.order();
    std::sort(order.begin(), order.end());
    std::vector<PatchIndex> all(patches.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(order, all);
    EXPECT_EQ(tree.place_count(), patches.size() + static_cast<PatchIndex>(tree.elements().size()));
  }
}

TEST(SurfaceTree, AreasAddUpAndRadiiBound) {
  for (const PatchSet& patches : Scenes()) {
    const SurfaceTree tree(patches);
    for (const Element& element : tree.elements()) {
      ASSERT_GE(element.end - element.begin, 2);
      double area = 0;
      const Vec3 some = patches.corners[tree.order()[element.begin]][0];
      for (PatchIndex k = element.begin; k < element.end; ++k) {
        const PatchIndex i = tree.order()[k];
        area += patches.area_m2[i];
        for (const Vec3& p : patches.corners[i]) {
          EXPECT_LE(Length(p - some), 2 * element.radius_m * (1 + 1e-12));
        }
      }
      EXPECT_NEAR(element.area_m2, area, 1e-12 * area);
      if (element.parent < 0) continue;
      const Element& parent = tree.elements()[element.parent];
      EXPECT_LE(parent.begin, element.begin);
      EXPECT_GE(parent.end, element.end);
      EXPECT_LT(element.end - element.begin, parent.end - parent.begin);
    }
  }
}

TEST(SurfaceTree, ElementsAreOfOneSideOneReflectanceAndFlat) {
  for (const PatchSet& patches : Scenes()) {
    const SurfaceTree tree(patches);
    for (const Element& element : tree.elements()) {
      const PatchIndex first = tree.order()[element.begin];
      for (PatchIndex k = element.begin; k < element.end; ++k) {
        const PatchIndex i = tree.order()[k];
        EXPECT_EQ(patches.source[i].node, patches.source[first].node);
        EXPECT_EQ(patches.is_back[i], patches.is_back[first]);
        EXPECT_EQ(patches.reflectance[i], patches.reflectance[first]);
        EXPECT_GT(Dot(PatchNormal(patches, i), PatchNormal(patches, first)),
                  std::cos(20 * M_PI / 180));
      }
    }
  }
}

// A box is six surfaces, whatever node they are of; each is one element of all its patches.
TEST(SurfaceTree, EveryWallOfARoomIsOneTree) {
  const PatchSet patches = PatchesOf(MakeBox(3, {0.5, 0.5, 0.5}, std::vector<Rgb>(6), 8));
  const SurfaceTree tree(patches);
  int roots = 0;
  for (const Element& element : tree.elements()) {
    if (element.parent >= 0) continue;
    ++roots;
    EXPECT_EQ(element.end - element.begin, 2 * 8 * 8);
    EXPECT_NEAR(element.area_m2, 9, 1e-12);
  }
  EXPECT_EQ(roots, 6);
}

// Two table tops of one primitive, far apart in one plane, and two shelves, one above the other.
TEST(SurfaceTree, WhatIsApartIsNotOneElement) {
  for (const Vec3 away : {Vec3{10, 0, 0}, Vec3{0, 1, 0}}) {
    Scene scene =
        SceneMaker().Quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {{0.5, 0.5, 0.5}, {}}, 2).Make();
    Primitive& primitive = scene.meshes[0].primitives[0];
    const size_t vertices = primitive.positions.size(), triangles = primitive.triangles.size();
    for (size_t v = 0; v < vertices; ++v) {
      auto p = primitive.positions[v];
      primitive.positions.push_back(
          {p[0] + static_cast<float>(away.x), p[1] + static_cast<float>(away.y), p[2]});
    }
    for (size_t t = 0; t < triangles; ++t) {
      auto triangle = primitive.triangles[t];
      for (auto& vertex : triangle) vertex += static_cast<uint32_t>(vertices);
      primitive.triangles.push_back(triangle);
    }
    const PatchSet patches = PatchesOf(scene);
    ASSERT_EQ(patches.size(), 16);
    const SurfaceTree tree(patches);
    ASSERT_FALSE(tree.elements().empty());
    for (const Element& element : tree.elements()) EXPECT_LE(element.area_m2, 1.0001);
  }
}

// Rays that hit patch hit[k] and rest at place place[k], a lumen each.
struct Rays {
  std::vector<PatchIndex> hit, place;
};

std::vector<Rgb> Pushed(const PatchSet& patches, const SurfaceTree& tree, const Rays& rays) {
  Arrived arrived(patches.size()), rested(tree.place_count());
  for (size_t k = 0; k < rays.hit.size(); ++k) {
    for (auto [sum, at] : {std::pair{&arrived, rays.hit[k]}, {&rested, rays.place[k]}}) {
      sum->flux_lm[at] = sum->flux_lm[at] + Rgb{1, 0.5, 0};
      ++sum->hits[at];
    }
  }
  return tree.PushDown(rested, arrived);
}

// Each ray rests at a random element around the patch that it hits, or there.
TEST(SurfaceTree, PushDownKeepsTheFlux) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const SurfaceTree tree(patches);
  TestRandom random(1);
  Rays rays;
  for (int k = 0; k < 5000; ++k) {
    rays.hit.push_back(static_cast<PatchIndex>(random.Below(patches.size() / 3)));
    rays.place.push_back(rays.hit.back());
    for (int32_t e = tree.ParentOf(rays.hit.back()); e >= 0 && random.Below(2) == 0;
         e = tree.elements()[e].parent) {
      rays.place.back() = patches.size() + e;
    }
  }
  Rgb sum;
  for (const Rgb& flux : Pushed(patches, tree, rays)) {
    EXPECT_GE(flux.r, -1e-9);
    sum = sum + flux;
  }
  EXPECT_NEAR(sum.r, 5000, 1e-9);
  EXPECT_NEAR(sum.g, 2500, 1e-9);
  EXPECT_EQ(sum.b, 0);
}

// One ray does not say where the light is: 1 / area on the patches of its element, 0 elsewhere.
TEST(SurfaceTree, PushDownSpreadsOneRayByArea) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const SurfaceTree tree(patches);
  const auto e = static_cast<PatchIndex>(tree.elements().size() / 2);
  const Element& element = tree.elements()[e];
  const std::vector<Rgb> at_patch =
      Pushed(patches, tree, {{tree.order()[element.begin]}, {patches.size() + e}});
  for (PatchIndex k = 0; k < patches.size(); ++k) {
    const PatchIndex i = tree.order()[k];
    const bool inside = k >= element.begin && k < element.end;
    EXPECT_NEAR(at_patch[i].r, inside ? patches.area_m2[i] / element.area_m2 : 0, 1e-14);
  }
}

// Many rays do: a square that is lit on one half only stays dark on the other.
TEST(SurfaceTree, PushDownFollowsWhatChanceDoesNotExplain) {
  const PatchSet patches = PatchesOf(
      SceneMaker().Quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {{0.5, 0.5, 0.5}, {}}, 8).Make());
  const SurfaceTree tree(patches);
  TestRandom random(1);
  Rays rays;
  while (rays.hit.size() < 20000) {
    const auto i = static_cast<PatchIndex>(random.Below(patches.size()));
    if (PatchCentroid(patches, i).x > 0) continue;  // the square's middle is the origin
    rays.hit.push_back(i);
    rays.place.push_back(patches.size());  // the whole square
  }
  const std::vector<Rgb> at_patch = Pushed(patches, tree, rays);
  const double each = 20000.0 / (patches.size() / 2);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const bool lit = PatchCentroid(patches, i).x < 0;
    // Chance spreads a patch's hits by sqrt(each); of that little comes through.
    EXPECT_NEAR(at_patch[i].r, lit ? each : 0, lit ? kSigmas * std::sqrt(each) : 0.01 * each);
  }
}

}  // namespace
}  // namespace lambert
