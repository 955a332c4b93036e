// A room and the boxes that stand in it, as quads. Where two boxes touch, or a box touches a wall,
// no face is made, and the surface around the contact has edges along its outline. So no light
// leaks under a table leg, and no patch lies half in the open, half under a box.
#pragma once

#include <array>
#include <vector>

#include "radiosity/core/vec3.h"

namespace lambert::examples {

// Axis-aligned; metres. `object` is carried to the faces and means nothing here.
struct Box {
  std::array<double, 3> lo, hi;
  int object = 0;
};

// Corners counter-clockwise seen from the side that shows.
struct Quad {
  std::array<Vec3, 4> corners;
  int object = 0;
};

// The six walls of a room: objects of the faces at low x, high x, low y, high y, low z, high z.
struct Room {
  std::array<double, 3> lo, hi;
  std::array<int, 6> objects;
};

// What shows of `boxes` inside `room`: they may touch and overlap (the earlier box wins). No edge
// of a quad is longer than `max_edge_m`. Every box cuts all others of the list, so boxes that are
// not near each other belong in lists of their own.
std::vector<Quad> BoxFaces(const std::vector<Box>& boxes, const Room& room, double max_edge_m);

// The walls of the room, seen from inside, without the parts that a box covers; finer toward narrow
// boxes. A part that lies in a region of `paint` gets its object instead of the wall's.
std::vector<Quad> RoomFaces(const Room& room, const std::vector<Box>& boxes,
                            const std::vector<Box>& paint, double max_edge_m);

}  // namespace lambert::examples
