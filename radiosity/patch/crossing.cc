#include "radiosity/patch/crossing.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "radiosity/core/bounds.h"

namespace lambert {
namespace {

std::array<Vec3, 3> CornersOf(const SplitPiece& piece) {
  return {piece[0].position, piece[1].position, piece[2].position};
}

SplitCorner Between(const SplitCorner& a, const SplitCorner& b, double t) {
  return {a.position + (b.position - a.position) * t,
          a.barycentric + (b.barycentric - a.barycentric) * t};
}

// Where an edge passes the plane that its ends are on both sides of. Either order gives equal bits.
SplitCorner Crossing(const SplitCorner& p, const SplitCorner& q, const TrianglePlane& plane) {
  const Vec3 &u = p.position, &v = q.position;
  const bool in_order = std::tie(u.x, u.y, u.z) < std::tie(v.x, v.y, v.z);
  const SplitCorner &a = in_order ? p : q, &b = in_order ? q : p;
  const double height_a = plane.Height(a.position), height_b = plane.Height(b.position);
  return Between(a, b, height_a / (height_a - height_b));
}

int SideOf(Vec3 p, const TrianglePlane& plane, double slack_m) {
  const double height = plane.Height(p);
  return height > slack_m ? 1 : height < -slack_m ? -1 : 0;
}

bool Meet(const Bounds& a, const Bounds& b, double slack_m) {
  const Vec3 gap = {std::max(a.low.x - b.high.x, b.low.x - a.high.x),
                    std::max(a.low.y - b.high.y, b.low.y - a.high.y),
                    std::max(a.low.z - b.high.z, b.low.z - a.high.z)};
  return std::max({gap.x, gap.y, gap.z}) <= slack_m;
}

Bounds BoxOf(const SplitPiece& piece) {
  Bounds box{piece[0].position, piece[0].position};
  for (const SplitCorner& corner : piece) box.Add(corner.position);
  return box;
}

// Puts the first part in the place of piece `i`, and the others at the end.
void Replace(size_t i, const std::vector<SplitPiece>& parts, std::vector<SplitPiece>* pieces) {
  (*pieces)[i] = parts.front();
  pieces->insert(pieces->end(), parts.begin() + 1, parts.end());
}

// The parts of a piece on both sides of the plane.
std::vector<SplitPiece> PartsOf(const SplitPiece& piece, const TrianglePlane& plane,
                                double slack_m) {
  int side[3];
  for (int k = 0; k < 3; ++k) side[k] = SideOf(piece[k].position, plane, slack_m);
  const auto [low, high] = std::minmax({side[0], side[1], side[2]});
  if (low != -1 || high != 1) return {piece};
  // Rotated so that the first corner is on the plane, or else alone on its side.
  int first = 0;
  const bool touches = side[0] * side[1] * side[2] == 0;
  while (touches ? side[first] != 0
                 : side[first] == side[(first + 1) % 3] || side[first] == side[(first + 2) % 3]) {
    ++first;
  }
  const SplitCorner &p = piece[first], &q = piece[(first + 1) % 3], &r = piece[(first + 2) % 3];
  if (touches) {
    const SplitCorner qr = Crossing(q, r, plane);
    return {{p, q, qr}, {p, qr, r}};
  }
  const SplitCorner pq = Crossing(p, q, plane), rp = Crossing(r, p, plane);
  if (Length(r.position - pq.position) < Length(rp.position - q.position)) {
    return {{p, pq, rp}, {pq, q, r}, {pq, r, rp}};
  }
  return {{p, pq, rp}, {pq, q, rp}, {q, r, rp}};
}

}  // namespace

TrianglePlane PlaneThrough(const std::array<Vec3, 3>& corners) {
  const Vec3 normal = Normalized(Cross(corners[1] - corners[0], corners[2] - corners[0]));
  return {normal, Dot(normal, corners[0])};
}

std::optional<Segment3> InsidePart(const Segment3& segment, const std::array<Vec3, 3>& triangle,
                                   Vec3 normal, double slack_m) {
  double begin = 0, end = 1;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = triangle[k], inward = Cross(normal, triangle[(k + 1) % 3] - a);
    const double most = slack_m * Length(inward);
    const double from = Dot(segment.from - a, inward) - most;
    const double to = Dot(segment.to - a, inward) - most;
    if (from <= 0 && to <= 0) return std::nullopt;
    if (from < 0) begin = std::max(begin, from / (from - to));
    if (to < 0) end = std::min(end, from / (from - to));
  }
  const Vec3 way = segment.to - segment.from;
  if (!(Length(way) * (end - begin) > slack_m)) return std::nullopt;
  return Segment3{segment.from + way * begin, segment.from + way * end};
}

std::optional<Segment3> MeetPlane(const std::array<Vec3, 3>& other, const TrianglePlane& plane,
                                  double slack_m) {
  int side[3];
  for (int k = 0; k < 3; ++k) side[k] = SideOf(other[k], plane, slack_m);
  Vec3 points[3];
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (side[k] == 0) points[count++] = other[k];
    if (side[k] * side[next] < 0) {
      const double a = plane.Height(other[k]), b = plane.Height(other[next]);
      points[count++] = other[k] + (other[next] - other[k]) * (a / (a - b));
    }
  }
  if (count != 2) return std::nullopt;
  return Segment3{points[0], points[1]};
}

void CutAlong(const Segment3& segment, const TrianglePlane& plane, Vec3 normal, double slack_m,
              std::vector<SplitPiece>* pieces) {
  Bounds box{segment.from, segment.from};
  box.Add(segment.to);
  for (size_t i = 0, count = pieces->size(); i < count; ++i) {
    const SplitPiece piece = (*pieces)[i];
    if (!Meet(box, BoxOf(piece), slack_m)) continue;
    if (InsidePart(segment, CornersOf(piece), normal, slack_m)) {
      Replace(i, PartsOf(piece, plane, slack_m), pieces);
    }
  }
}

void InsertCorner(Vec3 point, double slack_m, std::vector<SplitPiece>* pieces) {
  for (size_t i = 0, count = pieces->size(); i < count; ++i) {
    const SplitPiece piece = (*pieces)[i];
    if (!Meet({point, point}, BoxOf(piece), slack_m)) continue;
    int cut = -1;
    double where = 0;
    for (int k = 0; k < 3 && cut < 0; ++k) {
      const Vec3 a = piece[k].position, way = piece[(k + 1) % 3].position - a;
      const double length = Length(way), t = Dot(point - a, way) / (length * length);
      const bool is_inside = t * length > slack_m && (1 - t) * length > slack_m;
      if (!is_inside || Length(a + way * t - point) > slack_m) continue;
      cut = k;
      where = t;
    }
    if (cut < 0) continue;
    const SplitCorner &p = piece[cut], &q = piece[(cut + 1) % 3], &r = piece[(cut + 2) % 3];
    SplitCorner pq = Between(p, q, where);
    pq.position = point;
    Replace(i, {{p, pq, r}, {pq, q, r}}, pieces);
  }
}

}  // namespace lambert
