#include "radiosity/patch/coplanar_overlap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "radiosity/patch/box_pairs.h"
#include "radiosity/patch/overlap_area.h"

namespace lambert {
namespace {

using Corners = std::array<Vec3, 3>;

// All lengths are in diagonals of the scene.

// Rounding of a float32 coordinate as large as the diagonal.
constexpr double kRounding = 0x1p-24;
// What patches share must be wider than this.
constexpr double kLeastWidth = 4 * kRounding;

// Planes are put in cells by the components of their unit normal and their distance from the
// lowest corner. Rounding moves those of patches over a thousandth of the diagonal by less than the
// slack.
constexpr double kCells = 120, kSlack = 1e-4;  // of each number from 0 to 1
constexpr double kMiddleCell = 128.5;          // of 0, in its middle
constexpr int kCellBits = 8, kPatchBits = 31;

// Requires: -1 <= x <= 1, but for rounding.
uint64_t CellOf(double x) { return static_cast<uint64_t>(x * kCells + kMiddleCell); }

Vec3 TwiceTheArea(const Corners& corners) {
  return Cross(corners[1] - corners[0], corners[2] - corners[0]);
}

// What shares more than the least width has a larger area than this, as has the larger of two that
// share it. Smaller ones may have no normal at all.
bool IsTooSmall(const Corners& corners) {
  const Vec3 normal = TwiceTheArea(corners);
  constexpr double kArea = kLeastWidth * kLeastWidth;
  return !(Dot(normal, normal) > kArea * kArea);
}

// Length(a) is safe at any size and slow; in diagonals sizes are moderate. Requires: not too small.
Vec3 UnitNormal(const Corners& corners) {
  const Vec3 normal = TwiceTheArea(corners);
  return normal / std::sqrt(Dot(normal, normal));
}

// Places are measured from the scene's lowest corner: its origin may be far away, in the middle of
// what was left out.
struct Frame {
  Vec3 low_m;
  double per_m;
};

Corners InDiagonals(const Corners& corners_m, const Frame& frame) {
  Corners corners = corners_m;
  for (Vec3& p : corners) p = (p - frame.low_m) * frame.per_m;
  return corners;
}

Bounds BoundsOf(const Corners& corners) {
  Bounds bounds{corners[0], corners[0]};
  for (const Vec3& p : corners) bounds.Add(p);
  return bounds;
}

double LongestEdge(const Corners& c) {
  const Vec3 ab = c[1] - c[0], bc = c[2] - c[1], ca = c[0] - c[2];
  return std::sqrt(std::max({Dot(ab, ab), Dot(bc, bc), Dot(ca, ca)}));
}

// Whether `b` reaches over no edge of `a`, or one of them by less than the least width. Requires:
// `normal` is that of a.
bool LieApart(const Corners& a, const Corners& b, Vec3 normal) {
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = a[(k + 1) % 3] - a[k], inward = Cross(normal, edge);
    double height = 0;  // times the edge
    for (const Vec3& p : b) height = std::max(height, Dot(p - a[k], inward));
    if (height * height < kLeastWidth * kLeastWidth * Dot(edge, edge)) return true;
  }
  return false;
}

bool Overlap(const Corners& a, const Corners& b, Vec3 normal) {
  if (Dot(normal, Cross(b[1] - b[0], b[2] - b[0])) < 0) return false;
  for (const Vec3& p : b) {
    if (std::fabs(Dot(p - a[0], normal)) > kRounding) return false;
  }
  // What is narrow is small: most pairs end here.
  if (LieApart(a, b, normal) || LieApart(b, a, normal)) return false;
  return OverlapArea(a, b) > kLeastWidth * LongestEdge(b);
}

// The cells that the planes of patches are in, with their patches in ascending order:
// cell << kPatchBits | patch. A plane near a border is in each of its cells.
std::vector<uint64_t> SortByPlane(const PatchSet& patches, const Frame& frame) {
  std::vector<uint64_t> entries;
  entries.reserve(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Corners corners = InDiagonals(patches.corners[i], frame);
    if (IsTooSmall(corners)) continue;
    const Vec3 normal = UnitNormal(corners);
    std::array<uint64_t, 16> cells = {0};
    size_t count = 1;
    for (double x : {normal.x, normal.y, normal.z, Dot(normal, corners[0])}) {
      const uint64_t low = CellOf(x - kSlack);
      for (size_t c = 0; c < count; ++c) cells[c] = cells[c] << kCellBits | low;
      if (low == CellOf(x + kSlack)) continue;
      for (size_t c = 0; c < count; ++c) cells[count + c] = cells[c] + 1;
      count *= 2;
    }
    for (size_t c = 0; c < count; ++c) entries.push_back(cells[c] << kPatchBits | i);
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

}  // namespace

CoplanarOverlaps FindCoplanarOverlaps(const PatchSet& patches) {
  const Bounds scene = BoundsOf(patches);
  const Frame frame{scene.low, 1 / scene.Diagonal()};
  const std::vector<uint64_t> entries = SortByPlane(patches, frame);
  CoplanarOverlaps found;
  std::vector<bool> overlaps(patches.corners.size());
  std::vector<PatchIndex> members;  // of one cell
  std::vector<Corners> corners;
  std::vector<Bounds> boxes;
  const auto check = [&](size_t i, size_t j) {
    // The plane of the larger one is the better known.
    const bool swap = patches.area_m2[members[i]] < patches.area_m2[members[j]];
    const Corners &a = corners[swap ? j : i], &b = corners[swap ? i : j];
    if (!Overlap(a, b, UnitNormal(a))) return;
    overlaps[members[i]] = overlaps[members[j]] = true;
    const std::pair pair(members[i], members[j]);
    if (found.first == kNoPatch || pair < std::pair(found.first, found.other)) {
      std::tie(found.first, found.other) = pair;
    }
  };
  for (size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    members.clear();
    corners.clear();
    boxes.clear();
    for (; end < entries.size() && entries[end] >> kPatchBits == entries[begin] >> kPatchBits;
         ++end) {
      members.push_back(static_cast<PatchIndex>(entries[end] & ((uint64_t{1} << kPatchBits) - 1)));
    }
    if (members.size() == 1) continue;
    for (PatchIndex member : members) {
      corners.push_back(InDiagonals(patches.corners[member], frame));
      boxes.push_back(BoundsOf(corners.back()));
    }
    ForEachMeetingPair(boxes, kRounding, check);
  }
  found.patches = std::count(overlaps.begin(), overlaps.end(), true);
  return found;
}

}  // namespace lambert
