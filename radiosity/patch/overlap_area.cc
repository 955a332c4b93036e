#include "radiosity/patch/overlap_area.h"

namespace lambert {
namespace {

// A convex polygon; a triangle that three half planes have cut has six corners at most.
struct Polygon {
  std::array<Vec3, 6> corners;
  int size = 0;
};

// What of `polygon` is on the side of `from` that `inward` points to.
Polygon Clip(const Polygon& polygon, Vec3 from, Vec3 inward) {
  Polygon kept;
  for (int k = 0; k < polygon.size; ++k) {
    const Vec3 p = polygon.corners[k], q = polygon.corners[(k + 1) % polygon.size];
    const double height_p = Dot(p - from, inward), height_q = Dot(q - from, inward);
    if (height_p >= 0) kept.corners[kept.size++] = p;
    if (height_p * height_q < 0) {
      kept.corners[kept.size++] = p + (q - p) * (height_p / (height_p - height_q));
    }
  }
  return kept;
}

}  // namespace

double OverlapArea(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
  const Vec3 normal = Cross(a[1] - a[0], a[2] - a[0]);
  Polygon shared{{b[0], b[1], b[2]}, 3};
  for (int k = 0; k < 3 && shared.size > 0; ++k) {
    shared = Clip(shared, a[k], Cross(normal, a[(k + 1) % 3] - a[k]));
  }
  Vec3 twice_area;
  for (int k = 2; k < shared.size; ++k) {
    twice_area = twice_area + Cross(shared.corners[k - 1] - shared.corners[0],
                                    shared.corners[k] - shared.corners[0]);
  }
  return std::fabs(Dot(twice_area, Normalized(normal))) / 2;
}

}  // namespace lambert
