#include "radiosity/patch/split.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "radiosity/patch/morton.h"

namespace lambert {
namespace {

using Point = std::tuple<double, double, double>;
Point Key(Vec3 p) { return {p.x, p.y, p.z}; }

std::vector<SplitPiece> SplitAll(const std::vector<std::array<Vec3, 3>>& triangles, double edge) {
  std::vector<SplitPiece> pieces;
  for (const auto& triangle : triangles) SplitLongEdges(WholePiece(triangle), edge, &pieces);
  return pieces;
}

TEST(SplitLongEdges, PiecesCoverTheTriangleOnceWoundAlikeWithShortEdges) {
  const std::array<Vec3, 3> triangle = {Vec3{0, 0, 0}, Vec3{3, 0.2, 0}, Vec3{0.4, 1.1, 0}};
  const double whole = Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]).z / 2;
  for (double edge : {0.05, 0.3, 1.0, 2.9, 10.0}) {
    double area = 0, barycentric_area = 0;
    for (const auto& [a, b, c] : SplitAll({triangle}, edge)) {
      const double piece = Cross(b.position - a.position, c.position - a.position).z / 2;
      EXPECT_GT(piece, 0);
      area += piece;
      barycentric_area +=
          Dot(a.barycentric, Cross(b.barycentric, c.barycentric));  // 1 for the whole triangle
      EXPECT_LE(Length(b.position - a.position), edge);
      EXPECT_LE(Length(c.position - b.position), edge);
      EXPECT_LE(Length(a.position - c.position), edge);
    }
    EXPECT_NEAR(area, whole, 1e-12);
    EXPECT_NEAR(barycentric_area, 1, 1e-12);
  }
}

// Without T-junctions each directed edge inside the mesh has its reverse, and those without one lie
// on the border, whose length is known.
TEST(SplitLongEdges, NeighboursShareEveryPointOfTheirCommonEdge) {
  const Vec3 a{0, 0, 0}, b{1, 0.1, 0.2}, c{0.9, 1.3, 0}, d{-2, 0.7, 0.4};
  const std::vector<SplitPiece> pieces = SplitAll({{a, b, c}, {c, d, a}}, 0.11);
  std::set<std::pair<Point, Point>> edges;
  std::map<Point, Vec3> points;
  for (const SplitPiece& piece : pieces) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = piece[k].position, q = piece[(k + 1) % 3].position;
      points[Key(p)] = p;
      EXPECT_TRUE(edges.insert({Key(p), Key(q)}).second) << "an edge is used twice";
    }
  }
  double border_m = 0;
  for (const auto& [p, q] : edges) {
    if (!edges.contains({q, p})) border_m += Length(points[q] - points[p]);
  }
  EXPECT_NEAR(border_m, Length(b - a) + Length(c - b) + Length(d - c) + Length(a - d), 1e-12);
}

TEST(SplitLongEdges, WithoutALimitTheTriangleStaysWhole) {
  EXPECT_EQ(SplitAll({{Vec3{0, 0, 0}, Vec3{9, 0, 0}, Vec3{0, 9, 0}}}, 0).size(), 1u);
}

TEST(SplitLongEdges, EndsAtTheResolutionOfDouble) {
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_EQ(SplitAll({{Vec3{1, 1, 1}, Vec3{next, 1, 1}, Vec3{1, next, 1}}}, 1e-300).size(), 2u);
}

TEST(MinimumPieces, IsALowerBound) {
  const std::vector<std::array<Vec3, 3>> triangles = {
      {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}},
      {Vec3{0, 0, 0}, Vec3{5, 0, 0}, Vec3{2, 0.01, 0}}};
  for (const auto& triangle : triangles) {
    const double area = Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]).z / 2;
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, Length(triangle[(k + 1) % 3] - triangle[k]));
    }
    for (double edge : {0.02, 0.3, 2.0, 9.0}) {
      EXPECT_LE(MinimumPieces(area, longest, edge), SplitAll({triangle}, edge).size());
    }
  }
}

TEST(MortonCodes, FollowTheZCurveOfACube) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k)
    corners.push_back({1.0 * (k & 1), 1.0 * (k >> 1 & 1), 1.0 * (k >> 2)});
  const std::vector<uint64_t> codes = MortonCodes(corners);
  EXPECT_EQ(codes.front(), 0u);
  EXPECT_EQ(codes.back(), (uint64_t{1} << 63) - 1);
  for (int k = 1; k < 8; ++k) EXPECT_LT(codes[k - 1], codes[k]);
}

TEST(MortonCodes, OnePointAndNoPointAreFine) {
  EXPECT_TRUE(MortonCodes({}).empty());
  EXPECT_EQ(MortonCodes({{1e30, 2, 3}}), std::vector<uint64_t>{0});
}

}  // namespace
}  // namespace lambert
