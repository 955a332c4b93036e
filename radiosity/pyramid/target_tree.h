// What the rays of a patch may hit, and what a hit is worth, by parts of its hemisphere.
//
// The patches' Morton order is cut in halves down to single patches; every node sums up the worth
// of what is below it, so that the far is seen in bulk and the near one by one.
#pragma once

#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/pyramid/cells.h"
#include "radiosity/pyramid/cluster_tree.h"

namespace lambert {

// Immutable; any number of threads at once. The patch set must outlive it.
class TargetTree {
 public:
  // worth[j] >= 0: of flux that arrives at patch j.
  TargetTree(const PatchSet& patches, const std::vector<double>& worth);

  // m[p] = sum over the patches j in cell p of F_ij worth_j, for rays from the origin of `frame`:
  // f_p times the mean worth of a ray through p. Point to point form factors, nothing occluded;
  // nodes and pieces of patches seen under `opening` [rad] or less are taken as points: good to
  // some percent, which makes a density worse and no result wrong.
  std::vector<double> Moments(const LocalFrame& frame, const HemisphereCells& cells,
                              double opening) const;

 private:
  struct Node {
    Vec3 center;
    double radius = 0;
    double worth = 0;       // sum of worth_j A_j
    Vec3 normal;            // sum of worth_j A_j n_j
    PatchIndex patch = -1;  // of a leaf
    int32_t right = -1;     // the left child comes right after its parent
  };
  int32_t Build(const std::vector<double>& worth, PatchIndex begin, PatchIndex end);
  void AddPatch(PatchIndex j, const LocalFrame& frame, const HemisphereCells& cells, double opening,
                std::vector<double>& moments) const;

  const PatchSet& patches_;
  std::vector<double> worth_;
  std::vector<Vec3> normals_;
  std::vector<Node> nodes_;
};

}  // namespace lambert
