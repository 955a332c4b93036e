// Photometric files of lamps (IES LM-63 of 1986 to 2019).
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/vec3.h"
#include "radiosity/scene/sphere_table.h"

namespace lambert {

// What a lamp sends into each direction, in axes of the lamp: it aims along -z, its up is +y.
struct LampProfile {
  std::shared_ptr<const SphereTable> intensity_cd;
  Vec3 x, y, z;  // axes of the table; z is its pole
};

// Reads absolute photometry of type C (the pole is where the lamp aims, horizontal angles turn from
// +x towards +y) and type B (the pole is +x, vertical angles turn from the aim up, horizontal ones
// towards +x). Planes that symmetry leaves out are filled in. Candela are times the multiplier, the
// ballast factor and, in files before 2002, the ballast-lamp factor. Between its angles intensity
// is linear in both, in steps of at most one degree. What lamps lose by tilting (TILT=) is left
// out. SCENE_INVALID naming `name` for anything else.
absl::StatusOr<LampProfile> ReadIes(const std::string& name, const std::string& bytes);

}  // namespace lambert
