// The local frames in which hemispheres are divided.
#pragma once

#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"

namespace lambert {

// Origin at a centroid, z along the normal there.
struct LocalFrame {
  Vec3 origin, x, y, z;
  Vec3 ToLocal(Vec3 point) const {
    const Vec3 d = point - origin;
    return {Dot(d, x), Dot(d, y), Dot(d, z)};
  }
};

// Of a patch: x along its first edge.
LocalFrame PatchFrame(const PatchSet& patches, PatchIndex i);

// Of a place of the tree of `patches`. All places of one flat surface look the same way but for the
// tilt of their normals, so that what is known of an element's hemisphere holds for its patches.
LocalFrame PlaceFrame(const PatchSet& patches, const SurfaceTree& tree, PatchIndex place);

}  // namespace lambert
