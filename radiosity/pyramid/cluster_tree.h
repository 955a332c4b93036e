// Clusters of patches (Chr95), by which the patches inside a pyramid are counted.
//
// The patches' Morton order is cut in halves until few are left; every cluster knows a ball around
// its vertices. A cluster wholly inside one pyramid is counted whole; others are opened, and in the
// smallest every vertex is located once for all patches that share it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/pyramid/cells.h"
#include "radiosity/pyramid/local_frame.h"

namespace lambert {

// Which patches are counted: all but, as is asked, those that reflect nothing (JPS00, section 4)
// and the walls of rooms that no light reaches (radiosity/patch/unlit_rooms.h).
std::vector<bool> CountedPatches(const PatchSet& patches, bool count_black, bool count_unlit);

// Immutable; any number of threads may count at once.
class ClusterTree {
 public:
  // Of the patches that are counted, one of `counted` for each.
  using Corners = std::vector<std::array<Vec3, 3>>;
  ClusterTree(const Corners& corners, const std::vector<bool>& counted);

  // n_ip: the patches with at least one vertex in pyramid p, as seen in `frame` (JPS00, section 4).
  // counts[p] for each cell; a patch counts once in each that it touches.
  // `use_clusters` false tests every vertex: the same counts, for comparison.
  std::vector<int32_t> CountPatches(const LocalFrame& frame, const HemisphereCells& cells,
                                    bool use_clusters = true) const;

 private:
  struct Cluster {
    Vec3 center;
    double radius = 0;
    int32_t begin = 0, end = 0;     // counted patches, in Morton order
    int32_t left = -1, right = -1;  // -1: a leaf
    int32_t first_vertex = 0;       // of a leaf, in vertices_
    int32_t vertex_count = 0;
  };
  using Triangle = std::array<uint8_t, 3>;  // vertex numbers within a leaf

  struct Counted;
  int32_t Build(const Counted& patches, int32_t begin, int32_t end);
  void FillLeaf(const Counted& patches, Cluster& leaf);
  void CountLeaf(const Cluster& leaf, const LocalFrame& frame, const HemisphereCells& cells,
                 std::vector<int32_t>& counts) const;

  std::vector<Triangle> triangles_;
  std::vector<Vec3> vertices_;     // of each leaf, without repetition
  std::vector<Cluster> clusters_;  // clusters_[0] holds all, if there are any
};

}  // namespace lambert
