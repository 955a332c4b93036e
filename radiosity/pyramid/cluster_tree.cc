#include "radiosity/pyramid/cluster_tree.h"

#include <algorithm>

namespace lambert {
namespace {

constexpr int32_t kLeafPatches = 8;  // fewer open more clusters, more test more vertices

}  // namespace

LocalFrame PatchFrame(const PatchSet& patches, PatchIndex i) {
  const auto& corner = patches.corners[i];
  LocalFrame frame;
  frame.origin = PatchCentroid(patches, i);
  frame.z = PatchNormal(patches, i);
  frame.x = Normalized(corner[1] - corner[0]);
  frame.y = Cross(frame.z, frame.x);
  return frame;
}

ClusterTree::ClusterTree(const PatchSet& patches, bool count_black) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (count_black || Mean(patches.reflectance[i]) > 0) triangles_.push_back(patches.corners[i]);
  }
  if (!triangles_.empty()) Build(0, static_cast<int32_t>(triangles_.size()));
}

int32_t ClusterTree::Build(int32_t begin, int32_t end) {
  const int32_t index = static_cast<int32_t>(clusters_.size());
  clusters_.emplace_back();
  Vec3 low = triangles_[begin][0], high = low;
  for (int32_t i = begin; i < end; ++i) {
    for (const Vec3& p : triangles_[i]) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  Cluster cluster;
  cluster.center = (low + high) * 0.5;
  for (int32_t i = begin; i < end; ++i) {
    for (const Vec3& p : triangles_[i]) {
      cluster.radius = std::max(cluster.radius, Length(p - cluster.center));
    }
  }
  cluster.begin = begin;
  cluster.end = end;
  if (end - begin > kLeafPatches) {
    const int32_t middle = begin + (end - begin) / 2;
    cluster.left = Build(begin, middle);
    cluster.right = Build(middle, end);
  }
  clusters_[index] = cluster;
  return index;
}

void ClusterTree::CountVertices(const Cluster& cluster, const LocalFrame& frame,
                                const Hemisphere& hemisphere,
                                std::vector<int32_t>& counts) const {
  for (int32_t i = cluster.begin; i < cluster.end; ++i) {
    int pyramid[3];
    for (int k = 0; k < 3; ++k) {
      pyramid[k] = hemisphere.Locate(frame.ToLocal(triangles_[i][k]));
      const bool seen = (k > 0 && pyramid[k] == pyramid[0]) || (k > 1 && pyramid[k] == pyramid[1]);
      if (pyramid[k] >= 0 && !seen) ++counts[pyramid[k]];
    }
  }
}

std::vector<int32_t> ClusterTree::CountPatches(const LocalFrame& frame,
                                               const Hemisphere& hemisphere,
                                               bool use_clusters) const {
  std::vector<int32_t> counts(hemisphere.size(), 0);
  if (clusters_.empty()) return counts;
  if (!use_clusters) {
    CountVertices(clusters_[0], frame, hemisphere, counts);
    return counts;
  }
  std::vector<int32_t> open = {0};
  while (!open.empty()) {
    const Cluster& cluster = clusters_[open.back()];
    open.pop_back();
    const Vec3 center = frame.ToLocal(cluster.center);
    if (center.z < -cluster.radius * (1 + 1e-9)) continue;  // wholly below the horizon
    const int pyramid = hemisphere.Locate(center);
    if (pyramid >= 0 && hemisphere.HoldsBall(pyramid, center, cluster.radius)) {
      counts[pyramid] += cluster.end - cluster.begin;
    } else if (cluster.left < 0) {
      CountVertices(cluster, frame, hemisphere, counts);
    } else {
      open.push_back(cluster.right);
      open.push_back(cluster.left);
    }
  }
  return counts;
}

}  // namespace lambert
