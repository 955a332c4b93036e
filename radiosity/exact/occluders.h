// Which triangles could stand between two others: pairs that surely see each other need no rays
// (shafts, HW91).
#pragma once

#include <vector>

#include "radiosity/exact/form_factor.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Immutable; any thread.
class Occluders {
 public:
  // Keeps the triangles that have corners of others on both sides; the walls of a convex room are
  // none. The patch set may go afterwards.
  explicit Occluders(const PatchSet& patches);

  int size() const { return static_cast<int>(triangles_.size()); }
  // True only where nothing reaches into the convex hull of the two parts by more than the tracer
  // resolves. False says nothing.
  bool SurelyClear(const Polygon& from, const Polygon& to) const;

 private:
  struct Box {
    Vec3 center, half;
  };
  // A node and its left child lie side by side; its right child at `right`, 0 for a leaf.
  struct Node {
    Box box;
    int begin, end;
    int right = 0;
  };
  struct Shaft;

  int Build(int begin, int end);
  bool Reaches(const Shaft& shaft, const Triangle& triangle) const;

  double tolerance_m_ = 0;
  std::vector<Triangle> triangles_;  // in Morton order, as patches are
  std::vector<Node> nodes_;
};

}  // namespace lambert
