// Splits triangles until no edge is longer than wanted, without T-junctions between neighbours.
#pragma once

#include <array>
#include <vector>

#include "radiosity/core/vec3.h"

namespace lambert {

// A corner of a piece: where it is, and where in the triangle that was split.
struct SplitCorner {
  Vec3 position;     // metres
  Vec3 barycentric;  // weights of the three corners of the whole triangle; they sum to 1
};
using SplitPiece = std::array<SplitCorner, 3>;

// The fewest pieces that splitting could give, from area and longest edge: a bound to refuse a
// scene by before anything is made. Requires: max_edge_m > 0.
double MinimumPieces(double area_m2, double longest_edge_m, double max_edge_m);

// Appends pieces that cover `triangle` once, wound like it, each edge at most `max_edge_m` long.
// max_edge_m = 0: the triangle itself. An edge is cut in its middle, or not, by its two end points
// alone, so neighbours that share an edge also share every point on it.
// Requires: MinimumPieces is not huge.
void SplitTriangle(const std::array<Vec3, 3>& triangle, double max_edge_m,
                   std::vector<SplitPiece>* pieces);

}  // namespace lambert
