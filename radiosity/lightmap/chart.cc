#include "radiosity/lightmap/chart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "radiosity/core/disjoint_sets.h"

namespace lambert {
namespace {

// UV islands smaller than this part of 0..1 squared are points.
constexpr double kLeastUvArea = 1e-14;
// How far texture coordinates may stand outside 0..1 by rounding.
constexpr double kUvSlack = 1e-4;

Vec3 AreaVector(const SurfaceTriangle& triangle) {
  const auto& [a, b, c] = triangle.corners;
  return Cross(b - a, c - a) * 0.5;
}

double SignedArea(const FlatTriangle& t) {
  return ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])) /
         2;
}

// Equal points get equal numbers.
std::vector<std::array<int32_t, 3>> WeldVertices(const std::vector<SurfaceTriangle>& surface) {
  std::map<std::array<double, 3>, int32_t> known;
  std::vector<std::array<int32_t, 3>> welded(surface.size());
  for (size_t t = 0; t < surface.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = surface[t].corners[k];
      welded[t][k] =
          known.try_emplace({p.x, p.y, p.z}, static_cast<int32_t>(known.size())).first->second;
    }
  }
  return welded;
}

// The triangle at the other side of each edge (from corner k to the next), or -1: an edge of the
// surface, one that more than two share, or one where the winding turns over.
std::vector<std::array<int32_t, 3>> FindNeighbours(const std::vector<SurfaceTriangle>& surface) {
  struct Edge {
    int32_t from, to, triangle, corner;
  };
  const std::vector<std::array<int32_t, 3>> welded = WeldVertices(surface);
  std::vector<Edge> edges;
  for (size_t t = 0; t < surface.size(); ++t) {
    if (!surface[t].has_area) continue;
    for (int k = 0; k < 3; ++k) {
      edges.push_back({welded[t][k], welded[t][(k + 1) % 3], static_cast<int32_t>(t), k});
    }
  }
  const auto before = [](const Edge& a, const Edge& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  };
  std::stable_sort(edges.begin(), edges.end(), before);
  std::vector<std::array<int32_t, 3>> neighbours(surface.size(), {-1, -1, -1});
  for (const Edge& edge : edges) {
    const auto [same, same_end] = std::equal_range(edges.begin(), edges.end(), edge, before);
    const Edge turned{edge.to, edge.from, 0, 0};
    const auto [other, other_end] = std::equal_range(edges.begin(), edges.end(), turned, before);
    if (same_end - same == 1 && other_end - other == 1) {
      neighbours[edge.triangle][edge.corner] = other->triangle;
    }
  }
  return neighbours;
}

// Corners of the convex hull, counter-clockwise (Andrew's monotone chain).
std::vector<Point2> Hull(std::vector<Point2> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Point2> hull;
  for (int half = 0; half < 2; ++half) {
    const size_t first = hull.size();
    for (const Point2& p : points) {
      while (hull.size() >= first + 2 && SignedArea({hull[hull.size() - 2], hull.back(), p}) <= 0) {
        hull.pop_back();
      }
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// The direction of the hull's edge along which the rectangle around it has the least area.
Point2 BestAxis(const std::vector<Point2>& hull) {
  Point2 best{1, 0};
  double least = -1;
  for (size_t i = 0; i < hull.size(); ++i) {
    const Point2 a = hull[i], b = hull[(i + 1) % hull.size()];
    const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
    if (!(length > 0)) continue;
    const Point2 axis{(b[0] - a[0]) / length, (b[1] - a[1]) / length};
    Point2 low{1e300, 1e300}, high{-1e300, -1e300};
    for (const Point2& p : hull) {
      const Point2 turned{p[0] * axis[0] + p[1] * axis[1], p[1] * axis[0] - p[0] * axis[1]};
      for (int k = 0; k < 2; ++k) {
        low[k] = std::min(low[k], turned[k]);
        high[k] = std::max(high[k], turned[k]);
      }
    }
    const double area = (high[0] - low[0]) * (high[1] - low[1]);
    // A little less counts for nothing: equal rectangles are turned alike on every machine.
    if (least < 0 || area < least * (1 - 1e-9)) {
      least = area;
      best = axis;
    }
  }
  return best;
}

// Moves the chart to (0, 0) and measures it.
void Settle(Chart& chart) {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (const FlatTriangle& triangle : chart.flat_m) {
    for (const Point2& p : triangle) {
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  for (FlatTriangle& triangle : chart.flat_m) {
    for (Point2& p : triangle) p = {p[0] - low[0], p[1] - low[1]};
  }
  chart.size_m = {high[0] - low[0], high[1] - low[1]};
}

// Projects triangles onto the plane of the first of them.
Chart Project(const std::vector<SurfaceTriangle>& surface, std::vector<int32_t> triangles) {
  const SurfaceTriangle& seed = surface[triangles[0]];
  const Vec3 normal = Normalized(AreaVector(seed));
  const Vec3 right = Normalized(seed.corners[1] - seed.corners[0]), up = Cross(normal, right);
  Chart chart;
  chart.triangles = std::move(triangles);
  std::vector<Point2> points;
  for (int32_t t : chart.triangles) {
    FlatTriangle flat;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = surface[t].corners[k] - seed.corners[0];
      flat[k] = {Dot(p, right), Dot(p, up)};
      points.push_back(flat[k]);
    }
    chart.flat_m.push_back(flat);
  }
  const Point2 axis = BestAxis(Hull(std::move(points)));
  for (FlatTriangle& flat : chart.flat_m) {
    for (Point2& p : flat) {
      p = {p[0] * axis[0] + p[1] * axis[1], p[1] * axis[0] - p[0] * axis[1]};
    }
  }
  Settle(chart);
  return chart;
}

}  // namespace

std::vector<Chart> ChartsByNormal(const std::vector<SurfaceTriangle>& surface) {
  const double least_cosine = std::cos(kChartAngle * std::numbers::pi / 180);
  const std::vector<std::array<int32_t, 3>> neighbours = FindNeighbours(surface);
  std::vector<Vec3> normals(surface.size());
  std::vector<double> areas(surface.size());
  std::vector<bool> is_free(surface.size());
  std::vector<int32_t> order;
  for (size_t t = 0; t < surface.size(); ++t) {
    if (!surface[t].has_area) continue;
    const Vec3 area = AreaVector(surface[t]);
    areas[t] = Length(area);
    normals[t] = area / areas[t];
    is_free[t] = true;
    order.push_back(static_cast<int32_t>(t));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&areas](int32_t a, int32_t b) { return areas[a] > areas[b]; });
  std::vector<Chart> charts;
  for (int32_t seed : order) {
    if (!is_free[seed]) continue;
    std::vector<int32_t> grown = {seed};
    is_free[seed] = false;
    for (size_t next = 0; next < grown.size(); ++next) {
      for (int32_t t : neighbours[grown[next]]) {
        if (t < 0 || !is_free[t] || Dot(normals[t], normals[seed]) < least_cosine) continue;
        is_free[t] = false;
        grown.push_back(t);
      }
    }
    Chart chart = Project(surface, grown);
    if (!Overlap(chart.flat_m)) {
      charts.push_back(std::move(chart));
      continue;
    }
    for (int32_t t : grown) charts.push_back(Project(surface, {t}));
  }
  return charts;
}

std::vector<Chart> ChartsOfUv(const std::vector<SurfaceTriangle>& surface,
                              const std::vector<std::array<float, 2>>& uv) {
  if (uv.empty()) return {};
  std::vector<FlatTriangle> flat;
  std::vector<int32_t> triangles;
  DisjointSets vertices(uv.size());
  std::map<std::array<double, 5>, int32_t> known;  // a vertex by its place and its coordinates
  for (size_t t = 0; t < surface.size(); ++t) {
    if (!surface[t].has_area) continue;
    FlatTriangle triangle;
    for (int k = 0; k < 3; ++k) {
      const uint32_t vertex = surface[t].vertices[k];
      for (int axis = 0; axis < 2; ++axis) {
        triangle[k][axis] = uv[vertex][axis];
        if (!(triangle[k][axis] >= -kUvSlack && triangle[k][axis] <= 1 + kUvSlack)) return {};
      }
      const Vec3 p = surface[t].corners[k];
      const int32_t first =
          known.try_emplace({p.x, p.y, p.z, uv[vertex][0], uv[vertex][1]}, vertex).first->second;
      vertices.Join(static_cast<int32_t>(vertex), first);
      vertices.Join(static_cast<int32_t>(vertex), static_cast<int32_t>(surface[t].vertices[0]));
    }
    if (std::fabs(SignedArea(triangle)) < kLeastUvArea) return {};
    flat.push_back(triangle);
    triangles.push_back(static_cast<int32_t>(t));
  }
  if (Overlap(flat)) return {};
  std::map<int32_t, Chart> islands;
  for (size_t i = 0; i < flat.size(); ++i) {
    Chart& chart = islands[vertices.Find(static_cast<int32_t>(surface[triangles[i]].vertices[0]))];
    chart.triangles.push_back(triangles[i]);
    chart.flat_m.push_back(flat[i]);
  }
  std::vector<Chart> charts;
  for (auto& [root, chart] : islands) {
    // Metres per unit of u and of v: root of the mean over the area of |dP/du|^2, |dP/dv|^2.
    double area_m2 = 0;
    Point2 squares{};
    for (size_t i = 0; i < chart.triangles.size(); ++i) {
      const auto& [a, b, c] = surface[chart.triangles[i]].corners;
      const FlatTriangle& t = chart.flat_m[i];
      const double twice = 2 * SignedArea(t);
      const Vec3 ab = b - a, ac = c - a;
      const Vec3 du = (ab * (t[2][1] - t[0][1]) - ac * (t[1][1] - t[0][1])) / twice;
      const Vec3 dv = (ac * (t[1][0] - t[0][0]) - ab * (t[2][0] - t[0][0])) / twice;
      const double area = Length(Cross(ab, ac)) / 2;
      area_m2 += area;
      squares = {squares[0] + area * Dot(du, du), squares[1] + area * Dot(dv, dv)};
    }
    for (FlatTriangle& triangle : chart.flat_m) {
      for (Point2& p : triangle) {
        p = {p[0] * std::sqrt(squares[0] / area_m2), p[1] * std::sqrt(squares[1] / area_m2)};
      }
    }
    Settle(chart);
    charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace lambert
