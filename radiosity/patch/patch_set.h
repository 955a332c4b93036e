// The patches of a scene: flat one-sided Lambertian triangles, structure of arrays, in Morton order
// of their centroids. Immutable once built; safe to share between threads.
//
// A two-sided triangle is two patches that share its area: a front (as wound in the file) and a
// back (wound the other way), each the `twin` of the other, back right after front.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/bounds.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"
#include "radiosity/core/warning.h"
#include "radiosity/scene/scene.h"

namespace lambert {

using PatchIndex = int32_t;
inline constexpr PatchIndex kNoPatch = -1;

// Where a patch comes from: glTF indices; `triangle` counts within the primitive.
struct PatchSource {
  int32_t node = 0, mesh = 0, primitive = 0, triangle = 0;
  bool operator==(const PatchSource&) const = default;
};

struct PatchSet {
  Vec3 origin;                               // metres: world = origin + corner
  std::vector<std::array<Vec3, 3>> corners;  // metres, relative to `origin`, counter-clockwise
  std::vector<double> area_m2;               // > 0
  std::vector<Rgb> reflectance;              // 0..1
  std::vector<Rgb> exitance_lm_per_m2;       // emitted, >= 0
  std::vector<PatchIndex> twin;              // other side of the same triangle, or kNoPatch
  std::vector<uint8_t> is_back;              // 1 for the back of a two-sided triangle
  std::vector<PatchSource> source;
  std::vector<Light> lights;  // positions relative to `origin`
  // Annotations: for people and pictures, no influence on the solution.
  std::vector<std::string> node_names;  // by node index
  std::vector<Camera> cameras;          // translations relative to `origin`
  std::vector<Warning> warnings;        // of reading and of patching

  PatchIndex size() const { return static_cast<PatchIndex>(corners.size()); }
};

// Unit normal of the front side of patch i. Requires: 0 <= i < size().
Vec3 PatchNormal(const PatchSet& patches, PatchIndex i);
// Mean of the three corners, relative to `origin`.
Vec3 PatchCentroid(const PatchSet& patches, PatchIndex i);
// The box around all patches [m], relative to `origin`. Requires: a patch.
Bounds BoundsOf(const PatchSet& patches);
// The nodes that a user calls `name`: those of that name or, where there is none, that of this glTF
// index. None: empty.
std::vector<int32_t> NodesCalled(const std::vector<std::string>& node_names,
                                 const std::string& name);
// Whether one of the lights is a sky.
bool HasSky(const PatchSet& patches);
// Emitted flux of all patches and lights per channel [lm].
Rgb EmittedFlux(const PatchSet& patches);

// Canonical bytes (docs/formats.md, "patch set"): equal sets give equal bytes on every machine.
std::string EncodePatchSet(const PatchSet& patches);
// Fails with DATA_LOSS on bytes that EncodePatchSet did not make; never crashes.
absl::StatusOr<PatchSet> DecodePatchSet(const std::string& bytes);

}  // namespace lambert
