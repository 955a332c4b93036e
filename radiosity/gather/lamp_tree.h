// Which lamp a point looks at: emissive patches, chosen by what they may send there (SWZ96).
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/core/bounds.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// A binary tree over the emissive patches of a patch set, in its Morton order. Immutable.
class LampTree {
 public:
  explicit LampTree(const PatchSet& patches);

  bool empty() const { return lamps_.empty(); }

  struct Choice {
    PatchIndex lamp = kNoPatch;  // kNoPatch: nothing arrives from here, whatever stands between
    double probability = 0;
  };

  // The lamps as one point sees them: up to kMostPieces parts of the tree with what each may send.
  class Cut {
   public:
    // False where no lamp can light the point.
    bool lit() const { return !until_.empty() && until_.back() > 0; }
    // Picks a lamp by a number in [0, 1), in proportion to what it may send; `xi` is then the place
    // within the lamp's share, again uniform in [0, 1). Requires: lit().
    Choice Pick(double& xi) const;

   private:
    friend class LampTree;
    Cut(const LampTree& tree, Vec3 point, Vec3 normal)
        : tree_(tree), point_(point), normal_(normal) {}
    const LampTree& tree_;
    const Vec3 point_, normal_;
    std::vector<int32_t> pieces_;  // nodes
    std::vector<double> until_;    // what they and those before them may send
  };
  static constexpr int kMostPieces = 128;
  // `normal`: unit. The tree must outlive the cut.
  Cut CutFor(Vec3 point, Vec3 normal) const;

 private:
  struct Node {
    Bounds bounds;
    double flux_lm = 0;  // mean over channels
    int32_t lamp = -1;   // of a leaf: index into lamps_
    int32_t left = -1, right = -1;
  };
  int32_t Build(int32_t begin, int32_t end);
  double Worth(int32_t node, Vec3 point, Vec3 normal) const;
  double LampWorth(PatchIndex lamp, Vec3 point, Vec3 normal) const;

  const PatchSet& patches_;
  std::vector<PatchIndex> lamps_;
  std::vector<Node> nodes_;  // the root first
};

// A direction towards a lamp, and what arrives along it.
struct LampSample {
  Vec3 to_lamp;       // from the point to a place on the lamp [m]
  Rgb irradiance_lx;  // at the point, where nothing stands between
};

// A place on a lamp by two numbers in [0, 1), as the point sees it: even in solid angle where the
// lamp looks large, else even in area. The mean of irradiance_lx is what the lamp sends where
// nothing stands between. `normal`: unit.
LampSample SampleLamp(const PatchSet& patches, PatchIndex lamp, Vec3 point, Vec3 normal, double xi1,
                      double xi2);

}  // namespace lambert
