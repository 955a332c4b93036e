#include "radiosity/solve/mesh_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

// A unit square of 2 n x n patches that reflects half of what arrives.
PatchSet Floor(int n) {
  return PatchesOf(
      SceneMaker().Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}, n).Make());
}

// `irradiance` at the centres, by so many rays that there is no noise.
template <typename Irradiance>
Solution Lit(const PatchSet& patches, Irradiance irradiance, int64_t hits = int64_t{1} << 50) {
  Solution solution;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double e = irradiance(PatchCentroid(patches, i) + patches.origin);
    solution.irradiance_lx.push_back({e, e, e});
  }
  solution.std_error_lm_per_m2.resize(patches.corners.size());
  solution.hits.assign(patches.corners.size(), hits);
  return solution;
}

// Right-angled triangles of legs h: a linear irradiance of gradient g has the variance g^2 h^2 / 18
// in each, and the estimate is between that and four times it.
TEST(EstimateMeshError, OfALinearIrradianceIsItsVarianceWithinPatches) {
  for (int n : {8, 16}) {
    const PatchSet patches = Floor(n);
    const double exact = std::sqrt(1.0 / 18) / n / 1.5;
    const MeshError error =
        EstimateMeshError(patches, Lit(patches, [](Vec3 p) { return 1 + p.x; }));
    EXPECT_GT(error.rms_area, 0.9 * exact);
    EXPECT_LT(error.rms_area, 2 * exact);
  }
}

TEST(EstimateMeshError, OfAStepIsAtTheStepAndHalvesWithTheArea) {
  double before = 0;
  for (int n : {8, 16, 32}) {
    const PatchSet patches = Floor(n);
    // Through the patches, not along their edges.
    const auto step = [](Vec3 p) { return p.x + 0.3 * p.y < 0.6 ? 0.0 : 1.0; };
    const MeshError error = EstimateMeshError(patches, Lit(patches, step));
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      const Vec3 p = PatchCentroid(patches, i) + patches.origin;
      EXPECT_TRUE(error.squares[i] == 0 || std::fabs(p.x + 0.3 * p.y - 0.6) < 1.5 / n);
    }
    if (before > 0) {
      EXPECT_NEAR(error.rms_area / before, std::sqrt(0.5), 0.1);
    }
    before = error.rms_area;
  }
}

TEST(EstimateMeshError, ConstantLightHasNone) {
  const PatchSet patches = Floor(8);
  const MeshError error = EstimateMeshError(patches, Lit(patches, [](Vec3) { return 3; }));
  EXPECT_EQ(error.rms_area, 0);
}

// Without any real difference none is found in most of all pilots: the chance of one is bounded by
// kFalseShare. Of 90 pilots 4.5 or fewer are expected, and 12 in less than .2 %.
TEST(EstimateMeshError, NoiseAloneIsSeldomTakenForADifference) {
  const PatchSet patches = Floor(32);
  int found = 0;
  for (int mean : {5, 100, 5000}) {
    std::mt19937 random(static_cast<unsigned>(mean));
    std::poisson_distribution<int64_t> hits(mean);
    for (int pilot = 0; pilot < 30; ++pilot) {
      Solution solution = Lit(patches, [](Vec3) { return 0; });
      for (PatchIndex i = 0; i < patches.size(); ++i) {
        solution.hits[i] = hits(random);
        solution.irradiance_lx[i] = Rgb{1, 1, 1} * static_cast<double>(solution.hits[i]);
      }
      found += EstimateMeshError(patches, solution).rms_area > 0;
    }
  }
  EXPECT_LT(found, 12);
}

// A bright strip: of the patches that would be split, those beside its edges are few.
TEST(EstimateMeshError, FewOfTheDifferencesThatAreFoundAreNoise) {
  const PatchSet patches = Floor(32);
  std::mt19937 random(1);
  int found = 0, wrong = 0;
  for (int pilot = 0; pilot < 30; ++pilot) {
    Solution solution = Lit(patches, [](Vec3) { return 0; });
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      const Vec3 p = PatchCentroid(patches, i) + patches.origin;
      const double mean = std::fabs(p.x - 0.5) < 0.25 ? 400 : 200;
      solution.hits[i] = std::poisson_distribution<int64_t>(mean)(random);
      solution.irradiance_lx[i] = Rgb{1, 1, 1} * static_cast<double>(solution.hits[i]);
    }
    const MeshError error = EstimateMeshError(patches, solution);
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      const double x = PatchCentroid(patches, i).x + patches.origin.x;
      const bool at_edge = std::fabs(std::fabs(x - 0.5) - 0.25) < 1.0 / 32;
      found += error.squares[i] > 0;
      wrong += error.squares[i] > 0 && !at_edge;
    }
  }
  EXPECT_GT(found, 30 * 2 * 2 * 32 * 0.9);
  EXPECT_LT(wrong, 2 * kFalseShare * found) << "a pair splits two patches";
}

TEST(EstimateMeshError, ALargerStandardErrorIsBelieved) {
  const PatchSet patches = Floor(8);
  Solution solution = Lit(patches, [](Vec3 p) { return 1 + p.x; });
  EXPECT_GT(EstimateMeshError(patches, solution).rms_area, 0);
  for (Rgb& error : solution.std_error_lm_per_m2) error = {0.2, 0.2, 0.2};
  EXPECT_EQ(EstimateMeshError(patches, solution).rms_area, 0);
}

TEST(EstimateMeshError, WhatIsBlackOrDarkHasNone) {
  const PatchSet black =
      PatchesOf(SceneMaker().Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{}, {}}, 4).Make());
  EXPECT_EQ(EstimateMeshError(black, Lit(black, [](Vec3 p) { return p.x; })).rms_area, 0);
  const PatchSet patches = Floor(4);
  EXPECT_EQ(EstimateMeshError(patches, Lit(
                                           patches, [](Vec3) { return 0; }, 0))
                .rms_area,
            0);
}

// Across an edge of a room light differs without varying inside either wall.
TEST(EstimateMeshError, WallsOfDifferentPlanesAreNoNeighbours) {
  const PatchSet box = PatchesOf(MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6), 4));
  const auto by_wall = [&box](Vec3 p) {
    const Vec3 q = p - Vec3{0.5, 0.5, 0.5};
    return std::fabs(q.z) > 0.499 ? 5.0 : std::fabs(q.x) > 0.499 ? 2.0 : 1.0;
  };
  EXPECT_EQ(EstimateMeshError(box, Lit(box, by_wall)).rms_area, 0);
}

}  // namespace
}  // namespace lambert
