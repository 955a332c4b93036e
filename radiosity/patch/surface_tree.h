// The patches of flat surfaces in a hierarchy of elements (HSA91): what arrives at an element is
// spread evenly over its patches.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"

namespace lambert {

// Two or more patches of one glTF primitive that show the same side and reflectance and lie about
// in a plane. Its children are elements or single patches.
struct Element {
  int32_t parent = -1;            // an element before it, or -1: the whole of a flat surface
  PatchIndex begin = 0, end = 0;  // its patches, in SurfaceTree::order
  double area_m2 = 0;             // sum over its patches
  double radius_m = 0;            // half the diagonal of its bounding box
  Vec3 centroid, normal;          // means by area
  PatchIndex child[2] = {};       // places (SurfaceTree)
};

// Flux and the rays that brought it, by patch or by place (SurfaceTree).
struct Arrived {
  std::vector<Rgb> flux_lm;
  std::vector<int64_t> hits;
  explicit Arrived(size_t size) : flux_lm(size), hits(size) {}
};

// Immutable; a function of the patch set alone, which must outlive it.
class SurfaceTree {
 public:
  // Groups patches by primitive, side and reflectance; cuts a group until it is flat (normals
  // within 10 degrees of their mean, a tenth as thick as wide) and fills about a third of its
  // bounding box; then halves it across its longest extent down to single patches.
  explicit SurfaceTree(const PatchSet& patches);

  const std::vector<Element>& elements() const { return elements_; }
  const std::vector<PatchIndex>& order() const { return order_; }
  // The smallest element that holds a place beside itself; -1: none does.
  int32_t ParentOf(PatchIndex place) const {
    const auto n = static_cast<PatchIndex>(parent_.size());
    return place < n ? parent_[place] : elements_[place - n].parent;
  }

  // Places: patch i is place i, element e is place patches + e.
  PatchIndex place_count() const { return PlaceOf(static_cast<int32_t>(elements_.size())); }
  PatchIndex PlaceOf(int32_t element) const {
    return static_cast<PatchIndex>(parent_.size()) + element;
  }
  // The element that is the whole of a place's flat surface; -1: a patch that is of none.
  int32_t SurfaceOf(PatchIndex place) const;
  // Flux at each patch [lm] once what came to rest at each element is spread over its patches: by
  // area, and where more rays hit one half of an element than chance explains, as they hit. The sum
  // is kept but for rounding. `rested`: by place; `arrived`: the same flux where it hit, by patch.
  std::vector<Rgb> PushDown(const Arrived& rested, const Arrived& arrived) const;

 private:
  struct Extent;
  double AreaOf(PatchIndex place) const {
    const auto n = static_cast<PatchIndex>(parent_.size());
    return place < n ? patches_.area_m2[place] : elements_[place - n].area_m2;
  }
  Extent Measure(PatchIndex begin, PatchIndex end) const;
  // Returns the place of the patches [begin, end) of `order_`, if they are one.
  PatchIndex Build(PatchIndex begin, PatchIndex end, int32_t parent);

  const PatchSet& patches_;
  std::vector<Vec3> centroids_, normals_;  // while building
  std::vector<PatchIndex> order_;
  std::vector<int32_t> parent_;  // by patch
  std::vector<Element> elements_;
};

}  // namespace lambert
