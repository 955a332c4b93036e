#include "radiosity/patch/edge_marks.h"

#include <bit>
#include <cstdint>
#include <tuple>
#include <utility>

namespace lambert {
namespace {

// Lengths that differ by less are one: of such edges any may be the longest.
constexpr double kEqualLength = 1e-9;

std::array<Vec3, 2> Ordered(Vec3 a, Vec3 b) {
  const bool in_order = std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  return in_order ? std::array{a, b} : std::array{b, a};
}

// Whether an edge of the patch is marked, but none of its longest ones.
bool LacksLongest(const std::array<Vec3, 3>& corners, const EdgeMarks& marks, int* longest) {
  double length[3], most = 0;
  bool any = false;
  for (int k = 0; k < 3; ++k) {
    length[k] = Length(corners[(k + 1) % 3] - corners[k]);
    if (length[k] > most) {
      most = length[k];
      *longest = k;
    }
  }
  for (int k = 0; k < 3; ++k) {
    if (!marks.Has(corners[k], corners[(k + 1) % 3])) continue;
    if (length[k] >= most * (1 - kEqualLength)) return false;
    any = true;
  }
  return any;
}

}  // namespace

size_t EdgeMarks::Hash::operator()(const Edge& edge) const {
  uint64_t hash = 0;
  for (const Vec3& p : edge) {
    for (double x : {p.x, p.y, p.z}) {
      // Both zeros are one number. The factor is odd, and 2^64 over the golden ratio.
      hash = (std::rotl(hash, 23) ^ std::bit_cast<uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15u;
    }
  }
  return static_cast<size_t>(hash ^ (hash >> 32));
}

bool EdgeMarks::Add(Vec3 a, Vec3 b) { return edges_.insert(Ordered(a, b)).second; }
bool EdgeMarks::Has(Vec3 a, Vec3 b) const { return edges_.contains(Ordered(a, b)); }

EdgeMarks MarkPatches(const PatchSet& patches, const std::vector<PatchIndex>& split) {
  EdgeMarks marks;
  for (PatchIndex i : split) {
    const auto& [a, b, c] = patches.corners[i];
    marks.Add(a, b);
    marks.Add(b, c);
    marks.Add(c, a);
  }
  for (bool changed = !marks.empty(); changed;) {
    changed = false;
    for (const auto& corners : patches.corners) {
      int k = 0;
      if (LacksLongest(corners, marks, &k)) changed |= marks.Add(corners[k], corners[(k + 1) % 3]);
    }
  }
  return marks;
}

int64_t CountHalved(const PatchSet& patches, const EdgeMarks& marks) {
  int64_t count = patches.size();
  for (const auto& [a, b, c] : patches.corners) {
    count += int{marks.Has(a, b)} + int{marks.Has(b, c)} + int{marks.Has(c, a)};
  }
  return count;
}

}  // namespace lambert
