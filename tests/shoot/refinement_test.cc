#include "radiosity/shoot/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/shoot/shooter.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// All around, and straight down.
PatchSet WithLights(PatchSet patches) {
  Light sun{"", {}, {1, 1, 1}, Light::Kind::kDistant};
  sun.z = {0, -1, 0};
  patches.lights = {{"", {0, 0.5, 0}, {1, 1, 1}}, sun};
  return patches;
}

// The floor and the ceiling of a cube of 1 m, 16 x 16 squares each, and a ray from the middle of
// the one to the middle of the other.
class RefinementOfACube : public testing::Test {
 protected:
  RefinementOfACube()
      : patches_(WithLights(PatchesOf(MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6), 16)))),
        tree_(patches_),
        scene_(*RayScene::Create(patches_)) {
    const Vec3 middle = {0.01, 0, 0.02};  // the patch set's origin is the cube's middle
    batch_.Add(scene_->ToTrace(middle + Vec3{0, 0.499, 0}), {0, -1, 0});
    scene_->Trace(batch_);
    for (PatchIndex i = 0; i < patches_.size(); ++i) {
      const Vec3 d = PatchCentroid(patches_, i) - middle - Vec3{0, 0.5, 0};
      if (Length(d) < 0.05) ceiling_ = i;
    }
  }

  // Area of the patch or element where the ray comes to rest.
  double RestingArea(double flux, double size, uint32_t rays, double rays_per_m2,
                     PatchIndex emitter) const {
    PyramidOptions options;
    options.hier_flux = flux;
    options.hier_size = size;
    const Refinement refinement(patches_, *scene_, tree_, options);
    refinement.Prefetch(batch_.hit[0]);
    const PatchIndex place = refinement.Place({emitter, rays, 0, rays, {}}, rays_per_m2, batch_, 0);
    if (place < patches_.size()) {
      EXPECT_EQ(place, batch_.hit[0]);
      return patches_.area_m2[place];
    }
    return tree_.elements()[place - patches_.size()].area_m2;
  }

  const PatchSet patches_;
  const SurfaceTree tree_;
  const std::unique_ptr<RayScene> scene_;
  RayBatch batch_;
  PatchIndex ceiling_ = kNoPatch;
};

TEST_F(RefinementOfACube, WithoutFluxOrSizeRaysRestWhereTheyHit) {
  ASSERT_GE(batch_.hit[0], 0);
  const double patch = patches_.area_m2[batch_.hit[0]];
  EXPECT_EQ(RestingArea(0, 10, 1, 100, ceiling_), patch);
  EXPECT_EQ(RestingArea(1e9, 0, 1, 100, ceiling_), patch);
}

TEST_F(RefinementOfACube, WithMuchOfBothTheyRestOnTheWholeFloor) {
  EXPECT_NEAR(RestingArea(1e9, 10, 1, 100, ceiling_), 1, 1e-12);
}

// About sigma A A / pi rays go from A of the ceiling to A of the floor: elements halve, so the
// largest with no more is over half as large as it may be.
TEST_F(RefinementOfACube, TheLargestElementThatGetsFewEnoughRaysIsTaken) {
  for (double sigma : {1e2, 1e3, 1e4}) {
    const double most = std::sqrt(0.5 * std::numbers::pi / sigma);
    const double area = RestingArea(0.5, 10, 1, sigma, ceiling_);
    EXPECT_LE(area, 1.05 * most) << sigma;
    EXPECT_GE(area, 0.45 * most) << sigma;
  }
}

// Strong light is resolved: a visit of many rays makes elements small, whatever the others do.
TEST_F(RefinementOfACube, AVisitOfManyRaysRestsOnThePatch) {
  EXPECT_GT(RestingArea(0.5, 10, 1, 100, ceiling_), 0.05);
  EXPECT_EQ(RestingArea(0.5, 10, 100000, 100, ceiling_), patches_.area_m2[batch_.hit[0]]);
}

TEST_F(RefinementOfACube, TheRadiusIsBoundedByTheDistance) {
  // The floor's elements of a half, a quarter, an eighth: 1 m away.
  EXPECT_NEAR(RestingArea(1e9, 0.6, 1, 1, ceiling_), 0.5, 1e-12);
  EXPECT_NEAR(RestingArea(1e9, 0.36, 1, 1, ceiling_), 0.25, 1e-12);
}

// n rays of a point light, n A / (4 pi) of them to A of the floor.
TEST_F(RefinementOfACube, RaysOfAPointLightAreCountedOverTheSphere) {
  const double most = 0.5 * 4 * std::numbers::pi / 100;
  const double area = RestingArea(0.5, 10, 100, 1e9, patches_.size());
  EXPECT_LE(area, 1.05 * most);
  EXPECT_GE(area, 0.45 * most);
}

// n rays of a distant light over the square metre of the cube that it sees.
TEST_F(RefinementOfACube, RaysOfADistantLightAreCountedOverItsBeam) {
  const double most = 0.5 / 10;
  const double area = RestingArea(0.5, 10, 10, 1e9, patches_.size() + 1);
  EXPECT_LE(area, 1.05 * most);
  EXPECT_GE(area, 0.45 * most);
}

// Where rays come to rest does not depend on what else the unit shoots, and what has come to rest
// is what arrived (CheckLedger).
TEST(PhsHier, AUnitInPartsComesToRestAsAWhole) {
  const auto patches = std::make_shared<const PatchSet>(PatchesOf(MakeCornell(4)));
  ShootOptions options;
  options.method = Method::kPhsHier;
  options.pyramids.min_rays = 64;
  const auto shooter = *Shooter::Create(patches, options);
  WorkUnit unit{1, 2, 3, {}, 50};
  for (PatchIndex i = 0; i < 200; ++i) {
    const auto rays = static_cast<uint32_t>(1 + 7 * (i % 20));
    unit.visits.push_back({i, rays, 0, rays, {1 << 20, 1 << 21, 12345}});
  }
  const UnitResult whole = *shooter->Run(unit);
  ASSERT_TRUE(CheckLedger(unit, whole).ok()) << CheckLedger(unit, whole);
  EXPECT_GE(whole.rests.back().patch, patches->size());  // some rest at elements
  UnitResult merged;
  for (const Visit& visit : unit.visits) {
    const uint32_t half = visit.ray_count / 2;
    for (const auto& [begin, end] : {std::pair{0u, half}, {half, visit.ray_count}}) {
      Visit part = visit;
      part.ray_begin = begin;
      part.ray_end = end;
      MergeResult(*shooter->Run({1, 2, 3, {part}, 50}), merged);
    }
  }
  merged.cpu_seconds = whole.cpu_seconds;
  EXPECT_EQ(merged, whole);
}

}  // namespace
}  // namespace lambert
