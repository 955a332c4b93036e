#include "radiosity/patch/patch_set.h"

#include <algorithm>
#include <charconv>

#include "radiosity/patch/light.h"

namespace lambert {

Vec3 PatchNormal(const PatchSet& patches, PatchIndex i) {
  const auto& [a, b, c] = patches.corners[i];
  // Edges of unit size, so that the product of two tiny edges does not underflow.
  double scale = std::max({Length(b - a), Length(c - a), Length(c - b)});
  return Normalized(Cross((b - a) / scale, (c - a) / scale));
}

Vec3 PatchCentroid(const PatchSet& patches, PatchIndex i) {
  const auto& [a, b, c] = patches.corners[i];
  return (a + b + c) / 3;
}

Bounds BoundsOf(const PatchSet& patches) {
  Bounds bounds{patches.corners[0][0], patches.corners[0][0]};
  for (const auto& corners : patches.corners) {
    for (const Vec3& p : corners) bounds.Add(p);
  }
  return bounds;
}

std::vector<int32_t> NodesCalled(const std::vector<std::string>& node_names,
                                 const std::string& name) {
  std::vector<int32_t> nodes;
  for (size_t node = 0; node < node_names.size() && !name.empty(); ++node) {
    if (node_names[node] == name) nodes.push_back(static_cast<int32_t>(node));
  }
  if (!nodes.empty()) return nodes;
  int32_t index = -1;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, index);
  if (error == std::errc() && stop == end && index >= 0 &&
      static_cast<size_t>(index) < node_names.size()) {
    nodes.push_back(index);
  }
  return nodes;
}

bool HasSky(const PatchSet& patches) {
  return std::any_of(patches.lights.begin(), patches.lights.end(),
                     [](const Light& light) { return light.kind == Light::Kind::kSky; });
}

Rgb EmittedFlux(const PatchSet& patches) {
  Rgb flux_lm;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    flux_lm = flux_lm + patches.exitance_lm_per_m2[i] * patches.area_m2[i];
  }
  for (const Rgb& of_light : LightFlux(patches)) flux_lm = flux_lm + of_light;
  return flux_lm;
}

}  // namespace lambert
