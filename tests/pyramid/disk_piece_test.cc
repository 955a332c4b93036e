#include "radiosity/pyramid/disk_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "radiosity/pyramid/hemisphere.h"
#include "tests/support/sphere_bins.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

double Area(const DiskPiece& piece) {
  return (static_cast<double>(piece.edge1[0]) * piece.edge2[1] -
          static_cast<double>(piece.edge1[1]) * piece.edge2[0]) /
         2;
}

// What a piece takes of points that are uniform in its flat triangle.
double TakenFraction(const DiskPiece& piece, TestRandom& random, int groups) {
  const DiskPiece* lanes[8];
  std::fill(std::begin(lanes), std::end(lanes), &piece);
  const DiskPiece8 pieces(lanes);
  int64_t taken = 0;
  for (int k = 0; k < groups; ++k) {
    Float8 u, v;
    for (int lane = 0; lane < 8; ++lane) {
      u[lane] = static_cast<float>(random.Uniform());
      v[lane] = static_cast<float>(random.Uniform());
    }
    const DiskTrial trial = pieces.Try(u, v);
    for (int lane = 0; lane < 8; ++lane) {
      if (!trial.inside[lane]) continue;
      ++taken;
      const Vec3 d{trial.direction.x[lane], trial.direction.y[lane], trial.direction.z[lane]};
      EXPECT_NEAR(Length(d), 1, 1e-6);
      for (const float(&side)[3] : piece.side) {
        EXPECT_GT(d.x * side[0] + d.y * side[1] + d.z * side[2], -1e-6);
      }
    }
  }
  return static_cast<double>(taken) / (8.0 * groups);
}

// The points that a piece takes fill its image on the disk only if its flat triangle holds all of
// it: then their share of the flat triangle's area is the piece's flux.
TEST(CutOnDisk, PiecesTakeTheFluxOfTheirTriangle) {
  TestRandom random(1);
  for (const Hemisphere& hemisphere :
       {Hemisphere(4, 4, 0), Hemisphere(4, 4, 2), Hemisphere(3, 3, 2), Hemisphere(64, 3, 0)}) {
    for (int p = 0; p < hemisphere.size(); ++p) {
      const SphericalTriangle& t = hemisphere.pyramid(p);
      double before = 0;
      for (const DiskPiece& piece : CutOnDisk(t.a(), t.b(), t.c())) {
        constexpr int kGroups = 250;
        const double expected = kPi * (piece.until - before) * t.flux_fraction() / Area(piece);
        const double error = std::sqrt(expected * (1 - expected) / (8 * kGroups));
        // kSigmas holds for a few; here are some thousand. Rare hits: one more. Numbers in float.
        EXPECT_NEAR(TakenFraction(piece, random, kGroups), expected,
                    (kSigmas + 1) * error + 1.0 / (8 * kGroups) + 1e-6 / (piece.until - before))
            << p << " of " << hemisphere.size();
        before = piece.until;
      }
      EXPECT_EQ(before, 1);
    }
  }
}

TEST(CutOnDisk, PiecesTakeEnoughOfThePointsAndCompactTrianglesAreOne) {
  for (const Hemisphere& hemisphere :
       {Hemisphere(4, 4, 3), Hemisphere(3, 3, 4), Hemisphere(64, 4, 1), Hemisphere(64, 3, 2)}) {
    for (int p = 0; p < hemisphere.size(); ++p) {
      const SphericalTriangle& t = hemisphere.pyramid(p);
      double before = 0;
      const std::vector<DiskPiece> pieces = CutOnDisk(t.a(), t.b(), t.c());
      if (hemisphere.split() == 4) {
        EXPECT_EQ(pieces.size(), 1u);
      }
      for (const DiskPiece& piece : pieces) {
        const double part = piece.until - before;
        const double taken = kPi * part * t.flux_fraction() / Area(piece);
        EXPECT_TRUE(taken > 0.99 * kLeastTaken || part < 1.01 * kCuspFlux)
            << taken << " " << part << " " << p << " of " << hemisphere.size();
        EXPECT_LT(taken, 1.01);
        before = piece.until;
      }
    }
  }
}

}  // namespace
}  // namespace lambert
