#include "radiosity/pyramid/spherical_triangle.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "tests/support/sphere_bins.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 FromAngles(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}

struct NamedTriangle {
  const char* name;
  SphericalTriangle triangle;
};

// An octant, and what is harder: thin, small, along the horizon, around the pole.
std::vector<NamedTriangle> Triangles() {
  const Vec3 pole{0, 0, 1};
  return {
      {"octant", {pole, {1, 0, 0}, {0, 1, 0}}},
      {"third", {pole, FromAngles(kPi / 2, 0), FromAngles(kPi / 2, 2 * kPi / 3)}},
      {"sliver from the pole", {pole, FromAngles(1.5, 0.2), FromAngles(1.5, 0.21)}},
      {"thin", {FromAngles(0.3, 0), FromAngles(0.31, 0.02), FromAngles(0.9, 0.7)}},
      {"along the horizon", {FromAngles(1.5, 0.5), FromAngles(kPi / 2, 0), FromAngles(kPi / 2, 1)}},
      {"small", {FromAngles(0.8, 1), FromAngles(0.82, 1), FromAngles(0.81, 1.03)}},
      {"obtuse", {FromAngles(1.2, 0), FromAngles(1.3, 2.9), FromAngles(0.2, 1.5)}},
      {"around the pole", {FromAngles(0.9, 0), FromAngles(1.1, 2), FromAngles(0.7, 4)}}};
}

TEST(SphericalTriangle, SolidAngleEqualsAnotherFormula) {
  for (const auto& [name, t] : Triangles()) {
    EXPECT_NEAR(t.solid_angle(), SolidAngle(t.a(), t.b(), t.c()), 1e-14) << name;
  }
  EXPECT_NEAR(Triangles()[0].triangle.solid_angle(), kPi / 2, 1e-15);
}

// The quadrature's error falls with the fourth power of the edge of its 1024 pieces: 2^-5 rad or
// so.
TEST(SphericalTriangle, FluxFractionEqualsAQuadrature) {
  for (const auto& [name, t] : Triangles()) {
    EXPECT_NEAR(t.flux_fraction() / SphereBins::FluxFraction(t.a(), t.b(), t.c()), 1, 2e-6) << name;
  }
  EXPECT_NEAR(Triangles()[0].triangle.flux_fraction(), 0.25, 1e-15);
}

TEST(SphericalTriangle, PicksPiecesByTheirFlux) {
  const SphericalTriangle one = Triangles()[0].triangle;
  float xi = 0.375f;
  EXPECT_EQ(one.PickPiece(xi).until, 1);
  EXPECT_EQ(xi, 0.375f);
  // A crescent along the horizon is cut.
  const SphericalTriangle crescent(FromAngles(1.5, 1), FromAngles(kPi / 2, 0),
                                   FromAngles(kPi / 2, 2));
  const std::vector<DiskPiece> pieces = CutOnDisk(crescent.a(), crescent.b(), crescent.c());
  ASSERT_GT(pieces.size(), 3u);
  float before = 0;
  for (const DiskPiece& piece : pieces) {
    for (float at : {0.25f, 0.75f}) {
      xi = before + at * (piece.until - before);
      EXPECT_EQ(crescent.PickPiece(xi).until, piece.until);
      EXPECT_NEAR(xi, at, 2e-7 / (piece.until - before));
    }
    before = piece.until;
  }
  EXPECT_EQ(before, 1);
}

TEST(SphericalTriangle, SamplesAreUnitVectorsInside) {
  for (const auto& [name, t] : Triangles()) {
    const SphereBin whole(t);
    constexpr double kLast = 1 - 0x1p-24;
    for (double xi1 : {0.0, 0x1p-24, 0.1, 0.5, 0.9, kLast}) {
      for (double xi2 : {0.0, 0x1p-24, 0.1, 0.5, 0.9, kLast}) {
        const Vec3 d = t.SampleSolidAngle(xi1, xi2);
        EXPECT_NEAR(Length(d), 1, 1e-9) << name << " " << xi1 << " " << xi2;
        EXPECT_GT(whole.Inside(d), -1e-9) << name << " " << xi1 << " " << xi2;
      }
    }
    // xi2 = 0 is the vertex B. A sub-triangle of no area ends on the edge A B, but for the root of
    // a rounding error in 1 - q^2: 2e-8 or so.
    EXPECT_NEAR(Length(t.SampleSolidAngle(0.3, 0) - t.b()), 0, 1e-15) << name;
    const Vec3 on_edge = t.SampleSolidAngle(0, 0.5);
    EXPECT_NEAR(Dot(on_edge, Normalized(Cross(t.a(), t.b()))), 0, 1e-7) << name;
  }
}

TEST(SampleSolidAngle8, EqualsTheScalarSamplesBitForBit) {
  TestRandom random(5);
  const auto triangles = Triangles();
  for (int k = 0; k < 2000; ++k) {
    const SphericalTriangle* of_lane[8];
    alignas(32) float xi1[8], xi2[8];
    for (int lane = 0; lane < 8; ++lane) {
      of_lane[lane] = &triangles[random.Below(triangles.size())].triangle;
      xi1[lane] = k % 9 == 0 ? 0 : static_cast<float>(random.Below(1 << 24)) * 0x1p-24f;
      xi2[lane] = k % 7 == 0 ? 0 : static_cast<float>(random.Below(1 << 24)) * 0x1p-24f;
    }
    Directions8 out;
    SampleSolidAngle8(of_lane, xi1, xi2, out);
    for (int lane = 0; lane < 8; ++lane) {
      const Vec3 one = of_lane[lane]->SampleSolidAngle(static_cast<double>(xi1[lane]),
                                                       static_cast<double>(xi2[lane]));
      ASSERT_EQ((Vec3{out.x[lane], out.y[lane], out.z[lane]}), one) << k << " " << lane;
    }
  }
}

TEST(SphericalTriangle, SamplesAreUniformInSolidAngle) {
  TestRandom random(2);
  for (const auto& [name, t] : Triangles()) {
    const SphereBins bins(t, 3);
    std::vector<int64_t> counts(bins.size());
    for (int k = 0; k < 40000; ++k) {
      ++counts[bins.Find(t.SampleSolidAngle(random.Uniform(), random.Uniform()))];
    }
    EXPECT_LT(ChiSquared(counts, bins.SolidAngleShares()), ChiSquaredQuantile(bins.size() - 1))
        << name;
  }
}

}  // namespace
}  // namespace lambert
