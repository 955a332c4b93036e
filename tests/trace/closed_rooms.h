// Rooms out of which no ray may get.
#pragma once

#include <string>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "tests/support/cosine_shots.h"
#include "tests/support/scenes.h"

namespace lambert {

// `patches` turned about three axes by angles that no float represents.
PatchSet Turned(PatchSet patches);

struct Room {
  std::string name;
  PatchSet patches;
};
// Boxes, coarse and fine, square and flat; spheres of triangles.
std::vector<Room> ConvexRooms();
// A Cornell box closed in front.
PatchSet ClosedCornell(int n);

// A prism 1 m long whose cross-section has an angle of `angle_rad` between two sides of 1 m or
// more, cut to edges of at most `max_edge_m`.
PatchSet Wedge(double angle_rad, double max_edge_m);

// Shoots from every patch and expects every ray to arrive.
void ExpectNoLoss(const PatchSet& patches, int64_t rays, const std::string& name);

}  // namespace lambert
