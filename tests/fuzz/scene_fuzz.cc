// glTF bytes as a client sends them: the main file, and two files that it may name.
#include <string>

#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  const SceneBundle bundle{"room.glb", bytes, {{"data.bin", bytes}, {"image.png", bytes}}};
  const SceneLimits limits{.bytes = 1 << 20,
                           .triangles = 10'000,
                           .instances = 1000,
                           .image_pixels = 1 << 16,
                           .total_pixels = 1 << 18};
  ListExternalFiles(bundle.main_name, bytes).IgnoreError();
  const absl::StatusOr<Scene> scene = LoadGltf(bundle, limits);
  if (!scene.ok()) return;
  PatchOptions options;
  options.max_patches = 10'000;
  BuildPatches(*scene, options).IgnoreError();
}

}  // namespace lambert
