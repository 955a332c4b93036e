#include "radiosity/pyramid/disk_piece.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/pyramid/spherical_triangle.h"

namespace lambert {
namespace {

// Largest product of `m` with any direction of the great-circle arc between two unit vectors.
double FarthestOnArc(Vec3 p, Vec3 q, Vec3 m) {
  const Vec3 normal = Normalized(Cross(p, q));
  // The farthest point of the circle; it counts where it lies between p and q.
  const Vec3 top = m - Dot(m, normal) * normal;
  if (Dot(Cross(p, top), normal) > 0 && Dot(Cross(top, q), normal) > 0) return Length(top);
  return std::max(Dot(p, m), Dot(q, m));
}

// Largest product of `m` with any direction of a triangle's image on the disk.
double Reach(const Vec3 corners[3], Vec3 m) {
  double reach = FarthestOnArc(corners[0], corners[1], m);
  for (int k = 1; k < 3; ++k) {
    reach = std::max(reach, FarthestOnArc(corners[k], corners[(k + 1) % 3], m));
  }
  return reach;
}

// The flat triangle with lines parallel to the chords of the image, if they go around it
// counter-clockwise.
bool BoundByChords(const Vec3 corners[3], Vec3 bound[3]) {
  struct Line {
    double x, y, reach;  // the points with x X + y Y = reach
  } lines[3];
  for (int k = 0; k < 3; ++k) {
    const Vec3 p = corners[k], q = corners[(k + 1) % 3];
    const Vec3 out = Normalized(Vec3{q.y - p.y, p.x - q.x, 0});
    lines[k] = {out.x, out.y, Reach(corners, out)};
  }
  for (int k = 0; k < 3; ++k) {
    const Line &a = lines[k], &b = lines[(k + 1) % 3];
    const double determinant = a.x * b.y - a.y * b.x;
    if (determinant <= 0) return false;
    bound[k] = {(a.reach * b.y - b.reach * a.y) / determinant,
                (a.x * b.reach - b.x * a.reach) / determinant, 0};
  }
  return true;
}

// The flat triangle around the image's bounding box along the chord of `from` and `to`.
void BoundByBox(const Vec3 corners[3], Vec3 from, Vec3 to, Vec3 bound[3]) {
  const Vec3 x = Normalized(Vec3{to.x - from.x, to.y - from.y, 0}), y = {-x.y, x.x, 0};
  const double left = -Reach(corners, -x), low = -Reach(corners, -y);
  const double width = Reach(corners, x) - left, height = Reach(corners, y) - low;
  const Vec3 corner = left * x + low * y;
  bound[0] = corner - 0.5 * width * x;
  bound[1] = bound[0] + 2 * width * x;
  bound[2] = corner + 0.5 * width * x + 2 * height * y;
}

DiskPiece PieceOf(const Vec3 corners[3], const Vec3 bound[3]) {
  DiskPiece piece;
  const Vec3 edge1 = bound[1] - bound[0], edge2 = bound[2] - bound[0];
  const Vec3* points[3] = {&bound[0], &edge1, &edge2};
  float* const out[3] = {piece.corner, piece.edge1, piece.edge2};
  for (int k = 0; k < 3; ++k) {
    out[k][0] = static_cast<float>(points[k]->x);
    out[k][1] = static_cast<float>(points[k]->y);
    ToFloats(Normalized(Cross(corners[k], corners[(k + 1) % 3])), piece.side[k]);
  }
  return piece;
}

// Appends the pieces of a triangle, `until` the sum of their fluxes over `whole`.
void Cut(const Vec3 corners[3], double whole, double& flux, std::vector<DiskPiece>& pieces) {
  int longest = 0;
  const auto cosine = [&](int k) { return Dot(corners[k], corners[(k + 1) % 3]); };
  for (int k = 1; k < 3; ++k) {
    if (cosine(k) < cosine(longest)) longest = k;
  }
  const Vec3 p = corners[longest], q = corners[(longest + 1) % 3];
  const double part = FluxFraction(corners[0], corners[1], corners[2]) / whole;
  Vec3 bound[3];
  if (!BoundByChords(corners, bound)) BoundByBox(corners, p, q, bound);
  const double area = Cross(bound[1] - bound[0], bound[2] - bound[0]).z / 2;
  if (std::numbers::pi * part * whole >= kLeastTaken * area || part < kCuspFlux) {
    flux += part;
    pieces.push_back(PieceOf(corners, bound));
    pieces.back().until = static_cast<float>(flux);
    return;
  }
  const Vec3 apex = corners[(longest + 2) % 3], middle = Normalized(p + q);
  const Vec3 halves[2][3] = {{p, middle, apex}, {middle, q, apex}};
  for (const auto& half : halves) Cut(half, whole, flux, pieces);
}

}  // namespace

std::vector<DiskPiece> CutOnDisk(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 corners[3] = {a, b, c};
  std::vector<DiskPiece> pieces;
  double flux = 0;
  Cut(corners, FluxFraction(a, b, c), flux, pieces);
  pieces.back().until = 1;
  return pieces;
}

}  // namespace lambert
