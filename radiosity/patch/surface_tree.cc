#include "radiosity/patch/surface_tree.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lambert {
namespace {

constexpr double kLeastCosine = 0.985;  // of a normal to the mean: 10 degrees
constexpr double kMostThickness = 0.1;  // of a flat surface, over its radius
constexpr double kLeastFill = 0.3;      // area over that of the larger face of the bounding box

// The axis along which `size` is largest.
Vec3 LongestAxis(Vec3 size) {
  if (size.x >= size.y && size.x >= size.z) return {1, 0, 0};
  return size.y >= size.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
}

auto Group(const PatchSet& patches, PatchIndex i) {
  const PatchSource& s = patches.source[i];
  const Rgb& rho = patches.reflectance[i];
  return std::make_tuple(s.node, s.primitive, patches.is_back[i], rho.r, rho.g, rho.b);
}

// How far to believe that the halves of an element, the first with a share of the area, are lit
// unevenly: z^2 times over what chance would do to the rays that hit them (the garrote of Bre95:
// 1 - kDoubt^2 / z^2, 0 where that is negative).
double Trust(int64_t hits_a, int64_t hits_b, double share) {
  constexpr double kDoubt = 1.5;
  const double hits = static_cast<double>(hits_a + hits_b);
  const double deviation = static_cast<double>(hits_a) - share * hits;
  if (deviation == 0) return 0;
  const double chance = hits * share * (1 - share);
  return std::max(0.0, 1 - kDoubt * kDoubt * chance / (deviation * deviation));
}

}  // namespace

// What a range of patches looks like.
struct SurfaceTree::Extent {
  Bounds box, normals, centroids;
  Vec3 normal, centroid;  // means by area
  double area_m2 = 0, least_cosine = 1, thickness_m = 0;
  double radius_m() const { return 0.5 * box.Diagonal(); }
  bool IsFlat() const {
    return least_cosine >= kLeastCosine && thickness_m <= kMostThickness * radius_m();
  }
  bool FillsItsBox() const {
    const Vec3 s = box.Size();
    return area_m2 >= kLeastFill * std::max({s.x * s.y, s.y * s.z, s.z * s.x});
  }
};

SurfaceTree::Extent SurfaceTree::Measure(PatchIndex begin, PatchIndex end) const {
  const PatchIndex first = order_[begin];
  const Vec3 corner = patches_.corners[first][0], normal = normals_[first],
             centroid = centroids_[first];
  Extent extent{{corner, corner}, {normal, normal}, {centroid, centroid}, {}, {}};
  for (PatchIndex k = begin; k < end; ++k) {
    const PatchIndex i = order_[k];
    for (const Vec3& corner : patches_.corners[i]) extent.box.Add(corner);
    extent.normals.Add(normals_[i]);
    extent.centroids.Add(centroids_[i]);
    extent.normal = extent.normal + patches_.area_m2[i] * normals_[i];
    extent.centroid = extent.centroid + patches_.area_m2[i] * centroids_[i];
    extent.area_m2 += patches_.area_m2[i];
  }
  extent.centroid = extent.centroid / extent.area_m2;
  const double length = Length(extent.normal);
  extent.normal = length > 0 ? extent.normal / length : normals_[first];
  double low = 0, high = 0;
  for (PatchIndex k = begin; k < end; ++k) {
    extent.least_cosine = std::min(extent.least_cosine, Dot(normals_[order_[k]], extent.normal));
    const double height = Dot(centroids_[order_[k]] - centroids_[first], extent.normal);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  extent.thickness_m = high - low;
  return extent;
}

SurfaceTree::SurfaceTree(const PatchSet& patches)
    : patches_(patches), order_(patches.size()), parent_(patches.size(), -1) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    centroids_.push_back(PatchCentroid(patches, i));
    normals_.push_back(PatchNormal(patches, i));
  }
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](PatchIndex a, PatchIndex b) {
    return Group(patches, a) < Group(patches, b);
  });
  for (PatchIndex begin = 0, end = 0; begin < patches.size(); begin = end) {
    while (end < patches.size() && Group(patches, order_[end]) == Group(patches, order_[begin])) {
      ++end;
    }
    Build(begin, end, -1);
  }
  centroids_ = {};
  normals_ = {};
}

PatchIndex SurfaceTree::Build(PatchIndex begin, PatchIndex end, int32_t parent) {
  if (end - begin == 1) {
    parent_[order_[begin]] = parent;
    return order_[begin];
  }
  const Extent extent = Measure(begin, end);
  const bool is_element = parent >= 0 || (extent.IsFlat() && extent.FillsItsBox());
  if (is_element) {
    elements_.push_back(
        {parent, begin, end, extent.area_m2, extent.radius_m(), extent.centroid, extent.normal});
    parent = static_cast<int32_t>(elements_.size()) - 1;
  }
  // Apart by where they look, by the plane in which they lie, or by where they are.
  const bool by_normal = !is_element && extent.least_cosine < kLeastCosine;
  const bool by_plane = !is_element && !by_normal && !extent.IsFlat();
  const Vec3 axis = by_plane
                        ? extent.normal
                        : LongestAxis(by_normal ? extent.normals.Size() : extent.centroids.Size());
  const std::vector<Vec3>& where = by_normal ? normals_ : centroids_;
  const auto key = [&](PatchIndex i) { return Dot(where[i], axis); };
  double low = key(order_[begin]), high = low;
  for (PatchIndex k = begin; k < end; ++k) {
    low = std::min(low, key(order_[k]));
    high = std::max(high, key(order_[k]));
  }
  const double cut = low + (high - low) / 2;
  const auto first = order_.begin() + begin;
  const auto middle = std::stable_partition(first, order_.begin() + end,
                                            [&](PatchIndex i) { return key(i) < cut; });
  PatchIndex half = static_cast<PatchIndex>(middle - order_.begin());
  if (half == begin || half == end) half = begin + (end - begin) / 2;  // all in one place
  const PatchIndex lower = Build(begin, half, parent), upper = Build(half, end, parent);
  if (!is_element) return kNoPatch;
  elements_[parent].child[0] = lower;
  elements_[parent].child[1] = upper;
  return PlaceOf(parent);
}

int32_t SurfaceTree::SurfaceOf(PatchIndex place) const {
  const auto n = static_cast<PatchIndex>(parent_.size());
  int32_t surface = place < n ? parent_[place] : place - n;
  while (surface >= 0 && elements_[surface].parent >= 0) surface = elements_[surface].parent;
  return surface;
}

std::vector<Rgb> SurfaceTree::PushDown(const Arrived& rested, const Arrived& arrived) const {
  const size_t n = parent_.size();
  // What hit each place and rests above it.
  std::vector<Rgb> passed(rested.flux_lm.size());
  std::vector<int64_t> hits(rested.hits.size());
  const auto settle = [&](size_t place, const Rgb& flux, int64_t rays) {
    passed[place] = flux - rested.flux_lm[place];
    hits[place] = rays - rested.hits[place];
  };
  for (size_t i = 0; i < n; ++i) settle(i, arrived.flux_lm[i], arrived.hits[i]);
  for (size_t e = elements_.size(); e-- > 0;) {
    const auto [a, b] = elements_[e].child;
    settle(n + e, passed[a] + passed[b], hits[a] + hits[b]);
  }
  std::vector<Rgb> flux = rested.flux_lm;
  for (size_t e = 0; e < elements_.size(); ++e) {
    const auto [a, b] = elements_[e].child;
    const double area_share = AreaOf(a) / elements_[e].area_m2;
    const double trust = Trust(hits[a], hits[b], area_share);
    const Rgb both = passed[a] + passed[b];
    for (int c = 0; c < 3; ++c) {
      const double seen = both[c] > 0 ? std::clamp(passed[a][c] / both[c], 0.0, 1.0) : area_share;
      const double to_a = flux[n + e][c] * (area_share + trust * (seen - area_share));
      flux[a][c] += to_a;
      flux[b][c] += flux[n + e][c] - to_a;
    }
  }
  flux.resize(n);
  return flux;
}

}  // namespace lambert
