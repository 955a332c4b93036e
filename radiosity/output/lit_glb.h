// NAME.lit.glb: the scene's own materials, with its light as a lightmap, for engines.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/lightmap/atlas_part.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/lightmap_image.h"
#include "radiosity/output/view.h"

namespace lambert {

// glTF 2.0 binary as docs/formats.md says: materials and textures of scene.appearance as the file
// has them, each with MOZ_lightmap on TEXCOORD_1 and a page of `pages` (intensity in lx; RGBE by
// MOZ_texture_rgbe, PNG for readers without it), and the vertices' normals, tangents, colours and
// texture coordinates, whose sets from 1 on are moved up by one. Nodes, primitives and camera are
// those of NAME.lightmapped.glb (lightmap_glb.h). RESOURCE_EXHAUSTED (reason OUTPUT_TOO_LARGE) over
// 4 GiB. Requires: scene.appearance; images for each page; parts of these.
absl::StatusOr<std::string> EncodeLitGlb(const Scene& scene, const PatchSet& patches,
                                         const Atlas& atlas, const std::vector<AtlasPart>& parts,
                                         const std::vector<LightmapImages>& pages,
                                         const Exposure& exposure, const View& view);

}  // namespace lambert
