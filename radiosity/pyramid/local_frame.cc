#include "radiosity/pyramid/local_frame.h"

namespace lambert {

LocalFrame PatchFrame(const PatchSet& patches, PatchIndex i) {
  const auto& corner = patches.corners[i];
  LocalFrame frame;
  frame.origin = PatchCentroid(patches, i);
  frame.z = PatchNormal(patches, i);
  frame.x = Normalized(corner[1] - corner[0]);
  frame.y = Cross(frame.z, frame.x);
  return frame;
}

LocalFrame PlaceFrame(const PatchSet& patches, const SurfaceTree& tree, PatchIndex place) {
  const PatchIndex n = patches.size();
  const int32_t surface = tree.SurfaceOf(place);
  if (surface < 0) return PatchFrame(patches, place);
  const PatchIndex first = tree.order()[tree.elements()[surface].begin];
  LocalFrame frame = PatchFrame(patches, place < n ? place : first);
  if (place >= n) {
    const Element& element = tree.elements()[place - n];
    frame.origin = element.centroid;
    frame.z = element.normal;
  }
  const Vec3 along = PatchFrame(patches, first).x;
  frame.x = Normalized(along - Dot(along, frame.z) * frame.z);
  frame.y = Cross(frame.z, frame.x);
  return frame;
}

}  // namespace lambert
