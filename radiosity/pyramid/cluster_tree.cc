#include "radiosity/pyramid/cluster_tree.h"

#include <algorithm>

#include "radiosity/patch/unlit_rooms.h"

namespace lambert {
namespace {

// Fewer: more clusters to open. More: more vertices to locate. 3 * 64 still fits a uint8_t.
constexpr int32_t kLeafPatches = 64;

}  // namespace

std::vector<bool> CountedPatches(const PatchSet& patches, bool count_black, bool count_unlit) {
  std::vector<bool> counted(patches.size(), true);
  if (!count_unlit) {
    counted = FindUnlitWalls(patches);
    counted.flip();
  }
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    counted[i] = counted[i] && (count_black || Mean(patches.reflectance[i]) > 0);
  }
  return counted;
}

// The k-th of them, in Morton order.
struct ClusterTree::Counted {
  const Corners& corners;
  std::vector<PatchIndex> patches;
  const std::array<Vec3, 3>& operator[](int32_t k) const { return corners[patches[k]]; }
};

ClusterTree::ClusterTree(const Corners& corners, const std::vector<bool>& counted) {
  Counted patches{corners, {}};
  for (size_t i = 0; i < corners.size(); ++i) {
    if (counted[i]) patches.patches.push_back(static_cast<PatchIndex>(i));
  }
  triangles_.resize(patches.patches.size());
  if (triangles_.empty()) return;
  Build(patches, 0, static_cast<int32_t>(triangles_.size()));
  vertices_.shrink_to_fit();
  clusters_.shrink_to_fit();
}

int32_t ClusterTree::Build(const Counted& patches, int32_t begin, int32_t end) {
  const int32_t index = static_cast<int32_t>(clusters_.size());
  clusters_.emplace_back();
  Bounds bounds{patches[begin][0], patches[begin][0]};
  for (int32_t i = begin; i < end; ++i) {
    for (const Vec3& p : patches[i]) bounds.Add(p);
  }
  Cluster cluster;
  cluster.begin = begin;
  cluster.end = end;
  cluster.center = bounds.Center();
  for (int32_t i = begin; i < end; ++i) {
    for (const Vec3& p : patches[i]) {
      cluster.radius = std::max(cluster.radius, Length(p - cluster.center));
    }
  }
  if (end - begin > kLeafPatches) {
    const int32_t middle = begin + (end - begin) / 2;
    cluster.left = Build(patches, begin, middle);
    cluster.right = Build(patches, middle, end);
  } else {
    FillLeaf(patches, cluster);
  }
  clusters_[index] = cluster;
  return index;
}

void ClusterTree::FillLeaf(const Counted& patches, Cluster& leaf) {
  leaf.first_vertex = static_cast<int32_t>(vertices_.size());
  const auto first = static_cast<ptrdiff_t>(leaf.first_vertex);
  for (int32_t i = leaf.begin; i < leaf.end; ++i) {
    for (int k = 0; k < 3; ++k) {
      auto found = std::find(vertices_.begin() + first, vertices_.end(), patches[i][k]);
      triangles_[i][k] = static_cast<uint8_t>(found - vertices_.begin() - first);
      if (found == vertices_.end()) vertices_.push_back(patches[i][k]);
    }
  }
  leaf.vertex_count = static_cast<int32_t>(vertices_.size()) - leaf.first_vertex;
}

void ClusterTree::CountLeaf(const Cluster& leaf, const LocalFrame& frame,
                            const HemisphereCells& cells, std::vector<int32_t>& counts) const {
  int32_t located[3 * kLeafPatches];
  for (int32_t v = 0; v < leaf.vertex_count; ++v) {
    located[v] = cells.Locate(frame.ToLocal(vertices_[leaf.first_vertex + v]));
  }
  for (int32_t i = leaf.begin; i < leaf.end; ++i) {
    const int32_t p0 = located[triangles_[i][0]];
    const int32_t p1 = located[triangles_[i][1]];
    const int32_t p2 = located[triangles_[i][2]];
    if (p0 >= 0) ++counts[p0];
    if (p1 >= 0 && p1 != p0) ++counts[p1];
    if (p2 >= 0 && p2 != p0 && p2 != p1) ++counts[p2];
  }
}

std::vector<int32_t> ClusterTree::CountPatches(const LocalFrame& frame,
                                               const HemisphereCells& cells,
                                               bool use_clusters) const {
  std::vector<int32_t> counts(cells.size(), 0);
  if (clusters_.empty()) return counts;
  std::vector<int32_t> open = {0};
  while (!open.empty()) {
    const Cluster& cluster = clusters_[open.back()];
    open.pop_back();
    if (use_clusters) {
      const Vec3 center = frame.ToLocal(cluster.center);
      if (center.z < -cluster.radius * (1 + 1e-9)) continue;  // wholly below the horizon
      const int pyramid = cells.Locate(center);
      if (pyramid >= 0 && cells.HoldsBall(pyramid, center, cluster.radius)) {
        counts[pyramid] += cluster.end - cluster.begin;
        continue;
      }
    }
    if (cluster.left < 0) {
      CountLeaf(cluster, frame, cells, counts);
    } else {
      open.push_back(cluster.right);
      open.push_back(cluster.left);
    }
  }
  return counts;
}

}  // namespace lambert
