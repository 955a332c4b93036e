// The double integral of ln r over two straight edges, of which form factors are made.
#pragma once

#include "radiosity/core/vec3.h"

namespace lambert {

struct Edge {
  Vec3 from, to;
  Vec3 direction;     // unit
  double length = 0;  // > 0
  Vec3 At(double s) const { return from + direction * s; }
};
// Requires: from != to.
Edge EdgeBetween(Vec3 from, Vec3 to);

// integral over t in 0 .. edge.length of ln |x - edge(t)|, in closed form; x may lie on the edge.
double LogDistanceIntegral(Vec3 x, const Edge& edge);

// integral over s along p and t along q of ln |p(s) - q(t)|. In closed form where the edges share
// an end (corners equal bit for bit) or are one; else the outer integral is by Gauss and Legendre
// over pieces of p that are short against their distance from q, to about 1e-13 of the product of
// the lengths. Fastest where p is the shorter.
double LogDistanceIntegral(const Edge& p, const Edge& q);

}  // namespace lambert
