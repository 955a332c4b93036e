// The files of a scene that light it and that its glTF file does not hold: lamps and skies.
#pragma once

#include "absl/status/status.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// Reads every file of the bundle whose name ends in .ies (ies.h) or .exr (sky_map.h: clients send
// pictures of skies as sky maps). SCENE_INVALID naming the first that cannot be read.
absl::Status ReadLightFiles(const SceneBundle& bundle, Scene* scene);

// A lamp in the world, with the place and the axes of its node.
Light LampAt(const LampProfile& profile, const Transform& axes);

}  // namespace lambert
