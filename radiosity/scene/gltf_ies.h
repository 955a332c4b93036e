// Lamps of a glTF file by their photometric files (EXT_lights_ies).
#pragma once

#include <tiny_gltf.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/transform.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// The file's list of lamps. Their photometric files are those that `scene` has (light_files.h),
// data: URIs, or buffer views; each is read once, so lamps of one file share its table. Model and
// scene must outlive it.
class IesLamps {
 public:
  IesLamps(const tinygltf::Model& model, const Scene& scene);

  // The lamp of a node at `axes`; nullopt where it has none, or no axes. SceneError naming `where`
  // for lamps that do not exist or cannot be read.
  absl::StatusOr<std::optional<Light>> At(int node, const std::optional<Transform>& axes,
                                          const std::string& where);

 private:
  absl::StatusOr<LampProfile> ProfileOf(double index, const std::string& where);

  const tinygltf::Model& model_;
  const Scene& scene_;
  const std::vector<std::string> list_;  // entries, as JSON texts
  std::map<size_t, LampProfile> read_;   // by index in the list
};

}  // namespace lambert
