// Where one triangle passes through another, or stands on it.
#pragma once

#include <array>
#include <optional>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/split.h"

namespace lambert {

struct TrianglePlane {
  Vec3 normal;  // unit
  double offset_m = 0;
  double Height(Vec3 p) const { return Dot(normal, p) - offset_m; }
};
// Requires: the triangle has area.
TrianglePlane PlaneThrough(const std::array<Vec3, 3>& corners);

struct Segment3 {
  Vec3 from, to;
};

// What of a segment is inside a triangle by at least `slack_m`, seen along its normal; nullopt
// where that is shorter than the slack.
std::optional<Segment3> InsidePart(const Segment3& segment, const std::array<Vec3, 3>& triangle,
                                   Vec3 normal, double slack_m);

// Where triangle `other` meets the plane: a segment, or nullopt where it keeps more than `slack_m`
// off it, meets it in a point, or lies in it.
std::optional<Segment3> MeetPlane(const std::array<Vec3, 3>& other, const TrianglePlane& plane,
                                  double slack_m);

// Replaces those of `pieces` that `segment` goes through by their parts on both sides of `plane`,
// in which it lies. `normal`: of the pieces. Corners nearer to the plane than the slack are on it.
// A new corner depends on the plane and the ends of the edge that it divides alone.
void CutAlong(const Segment3& segment, const TrianglePlane& plane, Vec3 normal, double slack_m,
              std::vector<SplitPiece>* pieces);

// Divides each piece with an edge that passes within the slack of the point, but ends further off.
void InsertCorner(Vec3 point, double slack_m, std::vector<SplitPiece>* pieces);

}  // namespace lambert
