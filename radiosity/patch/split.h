// Splits triangles without T-junctions between neighbours: edges are halved, or not, by their end
// points alone, so neighbours that share an edge also share every point on it.
#pragma once

#include <array>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/edge_marks.h"

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

// Triangle `corners` as the one piece of itself.
SplitPiece WholePiece(const std::array<Vec3, 3>& corners);

// Appends pieces that cover `piece` once, wound like it, each edge at most `max_edge_m` long.
// max_edge_m = 0: the piece itself. Requires: MinimumPieces is not huge.
void SplitLongEdges(const SplitPiece& piece, double max_edge_m, std::vector<SplitPiece>* pieces);

// Replaces each piece by two to four where edges of it are marked, by one step of halving.
void HalveMarked(const EdgeMarks& marks, std::vector<SplitPiece>* pieces);

}  // namespace lambert
