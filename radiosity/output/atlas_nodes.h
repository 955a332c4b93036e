// Parts of an atlas as meshes of a GLB.
#pragma once

#include <functional>
#include <vector>

#include "radiosity/lightmap/atlas_part.h"
#include "radiosity/output/glb_writer.h"

namespace lambert {

// How a page of an atlas is sampled: charts end inside it.
GlbWriter::Json AtlasSampler();

// A primitive of the file: positions and triangles of `part`, beside `attributes`, which are names
// and accessors.
GlbWriter::Json AtlasPrimitive(const AtlasPart& part, GlbWriter::Json attributes, size_t material,
                               GlbWriter& writer);

// A node with a mesh for each instance that has parts, one primitive a part; then the camera where
// the picture was taken.
void AddAtlasNodes(const Scene& scene, const PatchSet& patches, const Atlas& atlas,
                   const std::vector<AtlasPart>& parts, const View& view,
                   const std::function<GlbWriter::Json(const AtlasPart&)>& make_primitive,
                   GlbWriter& writer);

}  // namespace lambert
