// Affine transforms, column vectors: p_world = linear * p + translation.
#pragma once

#include "radiosity/core/vec3.h"

namespace lambert {

struct Transform {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // columns of the linear part
  Vec3 translation;                         // metres

  Vec3 Vector(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3 Point(Vec3 p) const { return Vector(p) + translation; }
  // Negative where the transform mirrors, and so flips the winding of triangles.
  double Determinant() const { return Dot(x, Cross(y, z)); }
};

// The transform that applies `b` first, then `a`.
inline Transform operator*(const Transform& a, const Transform& b) {
  return {a.Vector(b.x), a.Vector(b.y), a.Vector(b.z), a.Point(b.translation)};
}

}  // namespace lambert
