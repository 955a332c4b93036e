// glTF materials -> Material.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/gltf_image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// One Material for each of the file; what `used` does not mark keeps its defaults, so that nothing
// is decoded for it. Base colour (or the diffuse one of KHR_materials_pbrSpecularGlossiness) is
// taken as diffuse reflectance, whatever the metalness, times the share that is not transmitted;
// emission is emissiveFactor * emissiveStrength.
absl::StatusOr<std::vector<Material>> ReadMaterials(const tinygltf::Model& model,
                                                    const std::vector<bool>& used,
                                                    TextureLoader* textures,
                                                    UnreadFeatures* unread);

}  // namespace lambert
