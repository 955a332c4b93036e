#include "radiosity/patch/duplicates.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace lambert {
namespace {

using Point = std::tuple<double, double, double>;

// The corners, beginning with the smallest: equal for every rotation of one triangle, different for
// the two windings.
std::array<Point, 3> CanonicalCorners(const std::array<Vec3, 3>& corners) {
  std::array<Point, 3> points;
  for (int k = 0; k < 3; ++k) points[k] = {corners[k].x, corners[k].y, corners[k].z};
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  return points;
}

}  // namespace

int64_t RemoveDuplicates(const std::vector<std::array<Vec3, 3>>& corners,
                         const std::vector<uint64_t>& codes, std::vector<PatchIndex>* order) {
  std::set<std::array<Point, 3>> seen;  // of the run of equal codes in hand
  std::vector<PatchIndex> kept;
  kept.reserve(order->size());
  for (size_t k = 0; k < order->size(); ++k) {
    const PatchIndex i = (*order)[k];
    const bool same_as_last = k > 0 && codes[(*order)[k - 1]] == codes[i];
    const bool same_as_next = k + 1 < order->size() && codes[(*order)[k + 1]] == codes[i];
    if (!same_as_last) seen.clear();
    if (!same_as_last && !same_as_next) {
      kept.push_back(i);
    } else if (seen.insert(CanonicalCorners(corners[i])).second) {
      kept.push_back(i);
    }
  }
  const int64_t removed = static_cast<int64_t>(order->size() - kept.size());
  *order = std::move(kept);
  return removed;
}

}  // namespace lambert
