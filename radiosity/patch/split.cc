#include "radiosity/patch/split.h"

namespace lambert {
namespace {

SplitCorner Midpoint(const SplitCorner& a, const SplitCorner& b) {
  return {(a.position + b.position) * 0.5, (a.barycentric + b.barycentric) * 0.5};
}

bool IsTooLong(const SplitCorner& a, const SplitCorner& b, double max_edge_m) {
  if (!(Length(b.position - a.position) > max_edge_m)) return false;
  // At the resolution of double there is no point between the ends: the edge has to stay.
  const Vec3 middle = Midpoint(a, b).position;
  return middle != a.position && middle != b.position;
}

void Split(const SplitPiece& piece, double max_edge_m, std::vector<SplitPiece>* pieces) {
  const auto& [a, b, c] = piece;
  const bool cut[3] = {IsTooLong(a, b, max_edge_m), IsTooLong(b, c, max_edge_m),
                       IsTooLong(c, a, max_edge_m)};
  const int cuts = cut[0] + cut[1] + cut[2];
  if (cuts == 0) {
    pieces->push_back(piece);
    return;
  }
  if (cuts == 3) {
    const SplitCorner ab = Midpoint(a, b), bc = Midpoint(b, c), ca = Midpoint(c, a);
    for (const SplitPiece& part : {SplitPiece{a, ab, ca}, SplitPiece{ab, b, bc},
                                   SplitPiece{ca, bc, c}, SplitPiece{ab, bc, ca}}) {
      Split(part, max_edge_m, pieces);
    }
    return;
  }
  // Rotated so that the first edge is cut, and with two cuts the last one is not.
  int first = 0;
  while (!cut[first] || (cuts == 2 && cut[(first + 2) % 3])) ++first;
  const SplitCorner &p = piece[first], &q = piece[(first + 1) % 3], &r = piece[(first + 2) % 3];
  const SplitCorner pq = Midpoint(p, q);
  if (cuts == 1) {
    Split({p, pq, r}, max_edge_m, pieces);
    Split({pq, q, r}, max_edge_m, pieces);
    return;
  }
  const SplitCorner qr = Midpoint(q, r);
  Split({pq, q, qr}, max_edge_m, pieces);
  // The rest is the quadrilateral p, pq, qr, r: cut along its shorter diagonal.
  if (Length(qr.position - p.position) < Length(r.position - pq.position)) {
    Split({p, pq, qr}, max_edge_m, pieces);
    Split({p, qr, r}, max_edge_m, pieces);
  } else {
    Split({p, pq, r}, max_edge_m, pieces);
    Split({pq, qr, r}, max_edge_m, pieces);
  }
}

}  // namespace

double MinimumPieces(double area_m2, double longest_edge_m, double max_edge_m) {
  // An equilateral triangle holds the most area for its edge, sqrt(3)/4 edge^2; and the pieces
  // along the longest edge are at least as many as the edge is long.
  const double edges = longest_edge_m / max_edge_m;
  return std::max({1.0, edges, area_m2 / max_edge_m / max_edge_m / (std::sqrt(3.0) / 4)});
}

void SplitTriangle(const std::array<Vec3, 3>& triangle, double max_edge_m,
                   std::vector<SplitPiece>* pieces) {
  const SplitPiece whole = {
      {{triangle[0], {1, 0, 0}}, {triangle[1], {0, 1, 0}}, {triangle[2], {0, 0, 1}}}};
  if (max_edge_m > 0) {
    Split(whole, max_edge_m, pieces);
  } else {
    pieces->push_back(whole);
  }
}

}  // namespace lambert
