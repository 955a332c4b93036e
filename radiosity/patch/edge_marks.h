// Edges that are to be halved, known by their end points, so that neighbours agree on them.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_set>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

class EdgeMarks {
 public:
  // The ends in either order; false where the edge is marked already.
  bool Add(Vec3 a, Vec3 b);
  bool Has(Vec3 a, Vec3 b) const;
  bool empty() const { return edges_.empty(); }

 private:
  using Edge = std::array<Vec3, 2>;  // the lesser end first
  struct Hash {
    size_t operator()(const Edge& edge) const;
  };
  std::unordered_set<Edge, Hash> edges_;
};

// Marks all edges of `split`, and then the longest edge of each patch of which another edge is
// marked, until nothing is missing (Riv84): halving them leaves no T-junction between patches that
// share an edge, and no angle far under half the least one there was.
EdgeMarks MarkPatches(const PatchSet& patches, const std::vector<PatchIndex>& split);

// How many patches there are once the marked edges are halved.
int64_t CountHalved(const PatchSet& patches, const EdgeMarks& marks);

}  // namespace lambert
