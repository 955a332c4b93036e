#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/lightmap/lightmap.h"

namespace lambert {
namespace {

constexpr int kSubTexels = 4;    // 4 x 4 points of a texel beside its centre
constexpr double kEdge = -1e-9;  // weights of points on an edge, with their rounding

// The points of a texel, relative to its centre, nearest first.
std::vector<Point2> TexelPattern() {
  std::vector<Point2> points = {{0, 0}};
  for (int y = 0; y < kSubTexels; ++y) {
    for (int x = 0; x < kSubTexels; ++x) {
      points.push_back({(x + 0.5) / kSubTexels - 0.5, (y + 0.5) / kSubTexels - 0.5});
    }
  }
  std::stable_sort(points.begin(), points.end(), [](const Point2& a, const Point2& b) {
    return a[0] * a[0] + a[1] * a[1] < b[0] * b[0] + b[1] * b[1];
  });
  return points;
}

// Draws patches into pages, keeping what is nearest to each texel's centre.
class TexelPainter {
 public:
  explicit TexelPainter(const Atlas& atlas) : pattern_(TexelPattern()) {
    for (const PageSize& size : atlas.pages) {
      const size_t texels = static_cast<size_t>(size.width) * size.height;
      pages_.push_back({size.width, size.height, std::vector<Texel>(texels)});
      distances_.emplace_back(texels, std::numeric_limits<float>::infinity());
    }
  }

  void Paint(const FlatTriangle& at, int32_t page, PatchIndex patch, int32_t triangle) {
    Point2 low = at[0], high = at[0];
    for (const Point2& p : at) {
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    const TexelPage& size = pages_[page];
    const auto cell = [](double place, int count) {
      return std::clamp(static_cast<int>(std::floor(place)), 0, count - 1);
    };
    const double twice = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                         (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
    if (twice != 0) {
      for (int y = cell(low[1], size.height); y <= cell(high[1], size.height); ++y) {
        for (int x = cell(low[0], size.width); x <= cell(high[0], size.width); ++x) {
          for (const Point2& offset : pattern_) {
            const Vec3 w = WeightsAt(at, {x + 0.5 + offset[0], y + 0.5 + offset[1]});
            if (std::min({w.x, w.y, w.z}) < kEdge) continue;
            Keep(page, x, y, offset, w, patch, triangle);
            break;
          }
        }
      }
    }
    const Point2 middle{(at[0][0] + at[1][0] + at[2][0]) / 3, (at[0][1] + at[1][1] + at[2][1]) / 3};
    const int x = cell(middle[0], size.width), y = cell(middle[1], size.height);
    constexpr double kThird = 1.0 / 3;
    Keep(page, x, y, {middle[0] - x - 0.5, middle[1] - y - 0.5}, {kThird, kThird, kThird}, patch,
         triangle);
  }

  std::vector<TexelPage> TakePages() { return std::move(pages_); }

 private:
  void Keep(int32_t page, int x, int y, Point2 offset, Vec3 weights, PatchIndex patch,
            int32_t triangle) {
    const size_t index = static_cast<size_t>(y) * pages_[page].width + x;
    const auto distance = static_cast<float>(offset[0] * offset[0] + offset[1] * offset[1]);
    if (!(distance < distances_[page][index])) return;
    distances_[page][index] = distance;
    pages_[page].texels[index] = {patch, static_cast<float>(std::max(weights.y, 0.0)),
                                  static_cast<float>(std::max(weights.z, 0.0)), triangle};
  }

  const std::vector<Point2> pattern_;
  std::vector<TexelPage> pages_;
  std::vector<std::vector<float>> distances_;  // squared, to the texel's centre
};

}  // namespace

std::vector<TexelPage> FindTexels(const Scene& scene, const PatchSet& patches, const Atlas& atlas) {
  const std::vector<int32_t> triangles = FindTriangles(scene, atlas.placed, patches);
  TexelPainter painter(atlas);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const int32_t triangle = triangles[i];
    const AtlasPlace& place = (patches.is_back[i] ? atlas.back : atlas.front)[triangle];
    if (place.page < 0) continue;
    FlatTriangle at;
    for (int k = 0; k < 3; ++k) {
      const Vec3 w = WeightsAt(atlas.placed.triangles[triangle].corners, patches.corners[i][k]);
      for (int axis = 0; axis < 2; ++axis) {
        at[k][axis] =
            w.x * place.texel[0][axis] + w.y * place.texel[1][axis] + w.z * place.texel[2][axis];
      }
    }
    painter.Paint(at, place.page, i, triangle);
  }
  return painter.TakePages();
}

Vec3 TexelPoint(const PatchSet& patches, const Texel& texel) {
  const auto& [a, b, c] = patches.corners[texel.patch];
  const double u = texel.u, v = texel.v;
  return a * (1 - u - v) + b * u + c * v;
}

}  // namespace lambert
