#include "radiosity/patch/morton.h"

#include <algorithm>

#include "radiosity/core/bounds.h"

namespace lambert {
namespace {

constexpr int kBits = 21;
constexpr double kCells = 1 << kBits;

// Spreads the 21 low bits of x so that two zero bits stand between neighbours.
uint64_t SpreadBits(uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

uint64_t Cell(double distance, double edge) {
  if (!(edge > 0)) return 0;
  return static_cast<uint64_t>(std::min(distance / edge * kCells, kCells - 1));
}

}  // namespace

std::vector<uint64_t> MortonCodes(const std::vector<Vec3>& points) {
  if (points.empty()) return {};
  Bounds bounds{points[0], points[0]};
  for (const Vec3& p : points) bounds.Add(p);
  const Vec3 size = bounds.Size();
  const double edge = std::max({size.x, size.y, size.z});
  std::vector<uint64_t> codes;
  codes.reserve(points.size());
  for (const Vec3& p : points) {
    const Vec3 d = p - bounds.low;
    codes.push_back(SpreadBits(Cell(d.x, edge)) | SpreadBits(Cell(d.y, edge)) << 1 |
                    SpreadBits(Cell(d.z, edge)) << 2);
  }
  return codes;
}

}  // namespace lambert
