// The files that light a scene: those of --sky and --ies, as they travel with it.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "app/options.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert::app {

// ReadSceneBundle, with the files of the options' lights: a sky's picture as a sky map, halved
// until it has few enough pixels. SCENE_FILE_MISSING or SCENE_INVALID naming a file that cannot be
// read, FIELD_INVALID for two files of one name.
absl::StatusOr<SceneBundle> ReadLitBundle(const std::string& scene_path, const Options& options);

}  // namespace lambert::app
