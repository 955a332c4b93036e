// Form factors against closed forms that the library does not use.
#include "radiosity/exact/form_factor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

using Square = std::array<Triangle, 2>;

Square MakeSquare(Vec3 origin, Vec3 u, Vec3 v) {
  return {Triangle{origin, origin + u, origin + u + v},
          Triangle{origin, origin + u + v, origin + v}};
}

double Between(const Square& a, const Square& b) {
  double sum = 0;
  for (const Triangle& x : a) {
    for (const Triangle& y : b) sum += ExchangeArea(x, y);
  }
  return sum;
}

// Howell C-11: equal rectangles a x b, face to face at distance c.
double Parallel(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return 2 / (std::numbers::pi * x * y) *
         (std::log(p * q / std::sqrt(1 + x * x + y * y)) + x * q * std::atan(x / q) +
          y * p * std::atan(y / p) - x * std::atan(x) - y * std::atan(y));
}

// Howell C-14: rectangles w x l and h x l that share the edge l at a right angle.
double Perpendicular(double h, double w) {
  const double h2 = h * h, w2 = w * w, s = h2 + w2;
  const double a = (1 + w2) * (1 + h2) / (1 + s);
  const double b = w2 * (1 + s) / ((1 + w2) * s), c = h2 * (1 + s) / ((1 + h2) * s);
  return (w * std::atan(1 / w) + h * std::atan(1 / h) - std::sqrt(s) * std::atan(1 / std::sqrt(s)) +
          0.25 * (std::log(a) + w2 * std::log(b) + h2 * std::log(c))) /
         (std::numbers::pi * w);
}

void ExpectRelative(double value, double expected, double tolerance) {
  EXPECT_NEAR(value / expected, 1, tolerance) << value << " instead of " << expected;
}

TEST(FormFactor, OfParallelRectanglesIsHowells) {
  for (const auto& [a, b, c] : {Vec3{1, 1, 1}, Vec3{2, 2, 1}, Vec3{10, 10, 1}, Vec3{1, 10, 1},
                                Vec3{0.1, 0.1, 1}, Vec3{100, 100, 1}, Vec3{1, 1, 0.001}}) {
    const Square low = MakeSquare({0, 0, 0}, {a, 0, 0}, {0, b, 0});
    const Square high = MakeSquare({0, 0, c}, {0, b, 0}, {a, 0, 0});
    ExpectRelative(Between(low, high) / (a * b), Parallel(a, b, c), 1e-11);
  }
  const Square low = MakeSquare({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Square high = MakeSquare({0, 0, 10}, {0, 1, 0}, {1, 0, 0});
  ExpectRelative(Between(low, high), 0.003162056838758, 1e-11);
  const Square far = MakeSquare({0, 0, 1000}, {0, 1, 0}, {1, 0, 0});
  ExpectRelative(Between(low, far), 3.183096739774e-7, 1e-11);
}

TEST(FormFactor, OfPerpendicularRectanglesIsHowells) {
  for (const auto& [h, w] :
       {std::pair{1.0, 1.0}, {1.0, 2.0}, {0.1, 0.1}, {10.0, 10.0}, {0.01, 1.0}}) {
    const Square floor = MakeSquare({0, 0, 0}, {1, 0, 0}, {0, w, 0});
    const Square wall = MakeSquare({0, 0, 0}, {0, 0, h}, {1, 0, 0});
    ExpectRelative(Between(floor, wall) / w, Perpendicular(h, w), 1e-11);
  }
}

// The squares share a part of an edge, corners do not meet.
TEST(FormFactor, IsAdditiveOverPartsOfAnEdge) {
  const Square floor = MakeSquare({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  double sum = 0;
  for (const auto& [from, to] : {std::pair{0.0, 0.3}, {0.3, 0.77}, {0.77, 1.0}}) {
    sum += Between(floor, MakeSquare({from, 0, 0}, {0, 0, 1}, {to - from, 0, 0}));
  }
  ExpectRelative(sum, Perpendicular(1, 1), 1e-12);
}

TEST(FormFactor, RowsOfClosedRoomsSumToOne) {
  for (const Scene& scene : {MakeFurnace(0.5, 1, 4), MakeBox(0.001, {}, std::vector<Rgb>(6), 3)}) {
    const PatchSet patches = PatchesOf(scene);
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      double sum = 0;
      for (PatchIndex j = 0; j < patches.size(); ++j) {
        if (j != i) sum += ExchangeArea(patches.corners[i], patches.corners[j]);
      }
      ExpectRelative(sum, patches.area_m2[i], 1e-11);
    }
  }
}

// A convex polyhedron of triangles of every shape.
TEST(FormFactor, RowsOfAnIcosphereSumToOne) {
  const PatchSet patches = PatchesOf(MakeIcosphere(3, {{}, {}, false}));
  for (PatchIndex i = 0; i < patches.size(); i += 37) {
    double sum = 0;
    for (PatchIndex j = 0; j < patches.size(); ++j) {
      if (j != i) sum += ExchangeArea(patches.corners[i], patches.corners[j]);
    }
    ExpectRelative(sum, patches.area_m2[i], 1e-11);
  }
}

TEST(FormFactor, IsSymmetric) {
  TestRandom random(1);
  const auto point = [&] {
    return Vec3{random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1)};
  };
  int seen = 0;
  for (int k = 0; k < 2000; ++k) {
    const Triangle a{point(), point(), point()}, b{point(), point(), point()};
    const double ab = ExchangeArea(a, b);
    EXPECT_NEAR(ab, ExchangeArea(b, a), 1e-12);
    seen += ab > 0;
  }
  EXPECT_GT(seen, 500);
}

// The four walls of a tetrahedron of any shape: each sees the other three.
TEST(FormFactor, OfSliversSumsToOne) {
  for (const double height : {1.0, 1e-3, 1e-6}) {
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0.3, 1, 0}, d{0.4, 0.3, height};
    const Triangle walls[] = {{a, b, c}, {a, d, b}, {b, d, c}, {c, d, a}};
    for (int i = 0; i < 4; ++i) {
      double sum = 0;
      for (int j = 0; j < 4; ++j) {
        if (j != i) sum += ExchangeArea(walls[i], walls[j]);
      }
      const Triangle& t = walls[i];
      ExpectRelative(sum, 0.5 * Length(Cross(t[1] - t[0], t[2] - t[0])), 1e-9);
    }
  }
}

// A triangle of 1e-6 m above the middle of one of 2 m: the large one fills a known solid angle.
TEST(FormFactor, OfATinyAndALargeTriangleIsThePointsOwn) {
  const double tiny = 1e-6;
  const Triangle small{Vec3{0, 0, 1}, Vec3{0, tiny, 1}, Vec3{tiny, 0, 1}};  // faces down
  const Square large = MakeSquare({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const double exchange = ExchangeArea(small, large[0]) + ExchangeArea(small, large[1]);
  // Four corners of Howell's B-3 with a = b = c.
  ExpectRelative(exchange / (0.5 * tiny * tiny), 4 * 0.1385316059949, 1e-6);
}

TEST(FormFactor, DoesNotDependOnScaleOrPlace) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const Vec3 at = Vec3{2, -1, 0.5} * scale;
    const Square b = MakeSquare(at, Vec3{1, 0, 0} * scale, Vec3{0, 1, 0} * scale);
    const Square c = MakeSquare(at, Vec3{0, 0, 1} * scale, Vec3{1, 0, 0} * scale);
    ExpectRelative(Between(b, c) / (scale * scale), Perpendicular(1, 1), 1e-10);
  }
}

TEST(FormFactor, IsZeroInOnePlaneAndFromBehind) {
  const Square floor = MakeSquare({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(Between(floor, MakeSquare({1, 0, 0}, {1, 0, 0}, {0, 1, 0})), 0);
  EXPECT_EQ(Between(floor, MakeSquare({0, 0, -1}, {0, 1, 0}, {1, 0, 0})), 0);
  EXPECT_EQ(Between(floor, MakeSquare({0, 0, 1}, {1, 0, 0}, {0, 1, 0})), 0);
}

// The half of the wall that hangs below the floor does not count.
TEST(FormFactor, CutsOffWhatIsBehind) {
  const Square floor = MakeSquare({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Square wall = MakeSquare({0, 0, -1}, {0, 0, 2}, {1, 0, 0});
  ExpectRelative(Between(floor, wall), Perpendicular(1, 1), 1e-11);
}

TEST(SolidAngle, OfAnOctantIsHalfPi) {
  const Triangle octant{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 1, 0}};  // faces the origin
  EXPECT_NEAR(SolidAngleFrom({0, 0, 0}, octant), std::numbers::pi / 2, 1e-15);
  EXPECT_EQ(SolidAngleFrom({2, 2, 2}, octant), 0);
}

}  // namespace
}  // namespace lambert
