#include "radiosity/patch/split.h"

#include <utility>

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

struct Parts {
  std::array<SplitPiece, 4> piece;
  int count = 0;
  void Add(const SplitCorner& a, const SplitCorner& b, const SplitCorner& c) {
    piece[count++] = {a, b, c};
  }
};

// The parts of a piece whose edges from corner k to the next are halved where cut[k].
Parts Divide(const SplitPiece& piece, const std::array<bool, 3>& cut) {
  const auto& [a, b, c] = piece;
  const int cuts = cut[0] + cut[1] + cut[2];
  Parts parts;
  if (cuts == 0) {
    parts.Add(a, b, c);
    return parts;
  }
  if (cuts == 3) {
    const SplitCorner ab = Midpoint(a, b), bc = Midpoint(b, c), ca = Midpoint(c, a);
    parts.Add(a, ab, ca);
    parts.Add(ab, b, bc);
    parts.Add(ca, bc, c);
    parts.Add(ab, bc, ca);
    return parts;
  }
  // Rotated so that the first edge is cut, and with two cuts the last one is not.
  int first = 0;
  while (!cut[first] || (cuts == 2 && cut[(first + 2) % 3])) ++first;
  const SplitCorner &p = piece[first], &q = piece[(first + 1) % 3], &r = piece[(first + 2) % 3];
  const SplitCorner pq = Midpoint(p, q);
  if (cuts == 1) {
    parts.Add(p, pq, r);
    parts.Add(pq, q, r);
    return parts;
  }
  const SplitCorner qr = Midpoint(q, r);
  parts.Add(pq, q, qr);
  // The rest is the quadrilateral p, pq, qr, r: cut along its shorter diagonal.
  if (Length(qr.position - p.position) < Length(r.position - pq.position)) {
    parts.Add(p, pq, qr);
    parts.Add(p, qr, r);
  } else {
    parts.Add(p, pq, r);
    parts.Add(pq, qr, r);
  }
  return parts;
}

}  // namespace

double MinimumPieces(double area_m2, double longest_edge_m, double max_edge_m) {
  // An equilateral triangle holds the most area for its edge, sqrt(3)/4 edge^2; and the pieces
  // along the longest edge are at least as many as the edge is long.
  const double edges = longest_edge_m / max_edge_m;
  return std::max({1.0, edges, area_m2 / max_edge_m / max_edge_m / (std::sqrt(3.0) / 4)});
}

SplitPiece WholePiece(const std::array<Vec3, 3>& corners) {
  return {{{corners[0], {1, 0, 0}}, {corners[1], {0, 1, 0}}, {corners[2], {0, 0, 1}}}};
}

void SplitLongEdges(const SplitPiece& piece, double max_edge_m, std::vector<SplitPiece>* pieces) {
  const auto& [a, b, c] = piece;
  std::array<bool, 3> cut = {};
  if (max_edge_m > 0) {
    cut = {IsTooLong(a, b, max_edge_m), IsTooLong(b, c, max_edge_m), IsTooLong(c, a, max_edge_m)};
  }
  if (cut == std::array<bool, 3>{}) {
    pieces->push_back(piece);
    return;
  }
  const Parts parts = Divide(piece, cut);
  for (int k = 0; k < parts.count; ++k) SplitLongEdges(parts.piece[k], max_edge_m, pieces);
}

void HalveMarked(const EdgeMarks& marks, std::vector<SplitPiece>* pieces) {
  std::vector<SplitPiece> halved;
  for (const SplitPiece& piece : *pieces) {
    std::array<bool, 3> cut;
    for (int k = 0; k < 3; ++k) {
      cut[k] = marks.Has(piece[k].position, piece[(k + 1) % 3].position);
    }
    const Parts parts = Divide(piece, cut);
    halved.insert(halved.end(), parts.piece.begin(), parts.piece.begin() + parts.count);
  }
  *pieces = std::move(halved);
}

}  // namespace lambert
