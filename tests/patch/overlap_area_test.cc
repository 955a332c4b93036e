#include "radiosity/patch/overlap_area.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr Corners kHalfSquare = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}};

TEST(OverlapArea, IsThatOfTheSharedPolygon) {
  struct Case {
    Corners b;
    double area;
  };
  for (const auto& [b, area] :
       {Case{kHalfSquare, 0.5},
        Case{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, 0.25},  // the other diagonal
        Case{{Vec3{0.5, 0.1, 0}, Vec3{0.9, 0.1, 0}, Vec3{0.9, 0.5, 0}}, 0.08},  // inside
        Case{{Vec3{-9, -9, 0}, Vec3{9, -9, 0}, Vec3{0, 9, 0}}, 0.5},            // around
        Case{{Vec3{0.5, -1, 0}, Vec3{2, -1, 0}, Vec3{2, 0.5, 0}}, 0},           // touches a corner
        Case{{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}, 0},                 // shares an edge
        Case{{Vec3{3, 0, 0}, Vec3{4, 0, 0}, Vec3{4, 1, 0}}, 0}}) {
    EXPECT_NEAR(OverlapArea(kHalfSquare, b), area, 1e-15);
    EXPECT_NEAR(OverlapArea(kHalfSquare, {b[0], b[2], b[1]}), area, 1e-15) << "wound otherwise";
    EXPECT_NEAR(OverlapArea(b, kHalfSquare), area, 1e-13);
  }
}

TEST(OverlapArea, OfTheStarOfTwoTrianglesIsAHexagon) {
  const auto triangle = [](double turn) {
    Corners corners;
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + 2.0943951023931953 * k;
      corners[k] = {0, std::cos(angle), std::sin(angle)};
    }
    return corners;
  };
  // Of an equilateral triangle the star's hexagon is two thirds.
  EXPECT_NEAR(OverlapArea(triangle(0), triangle(1.0471975511965976)), 0.75 * std::sqrt(3) * 2 / 3,
              1e-14);
}

}  // namespace
}  // namespace lambert
