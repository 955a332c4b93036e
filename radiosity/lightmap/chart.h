// Surfaces cut into charts: pieces that lie flat without overlap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/lightmap/placed_scene.h"

namespace lambert {

using Point2 = std::array<double, 2>;
using FlatTriangle = std::array<Point2, 3>;

struct Chart {
  std::vector<int32_t> triangles;    // of the surface
  std::vector<FlatTriangle> flat_m;  // by entry of `triangles`: the corners, metres, from (0, 0)
  Point2 size_m{};                   // up to there
};

// Largest angle between the normal of a chart's plane and those of its triangles [degrees].
inline constexpr double kChartAngle = 30;

// Charts by normal and adjacency: from the largest triangle that is left, over shared edges, to
// those that turn by less than kChartAngle from it; projected onto its plane and turned so that the
// rectangle around it is least. Where a projection overlaps itself, as that of a spiral stair, each
// of its triangles is a chart. Every triangle with area is in one chart.
std::vector<Chart> ChartsByNormal(const std::vector<SurfaceTriangle>& surface);

// Charts that keep the shape of existing texture coordinates, one for each island of them
// (triangles that share a vertex), each scaled along u and v to its mean size in metres. Empty
// where `uv` cannot serve as a lightmap's: absent, outside 0..1, without area somewhere, or
// overlapping.
std::vector<Chart> ChartsOfUv(const std::vector<SurfaceTriangle>& surface,
                              const std::vector<std::array<float, 2>>& uv);

// Whether points of some triangle lie inside another one. Ten points of each are looked at.
bool Overlap(const std::vector<FlatTriangle>& triangles);

// Weights of the three corners at `p`; they sum to 1. Requires: the triangle has an area.
Vec3 WeightsAt(const FlatTriangle& triangle, Point2 p);

}  // namespace lambert
