#include "radiosity/output/atlas_nodes.h"

#include <array>
#include <map>
#include <utility>

#include "radiosity/output/float_value.h"

namespace lambert {

using Json = GlbWriter::Json;

Json AtlasSampler() {
  constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;
  return {{"magFilter", kLinear},
          {"minFilter", kLinearMipmapLinear},
          {"wrapS", kClampToEdge},
          {"wrapT", kClampToEdge}};
}

Json AtlasPrimitive(const AtlasPart& part, Json attributes, size_t material, GlbWriter& writer) {
  std::vector<std::array<float, 3>> positions;
  for (const Vec3& p : part.position_m) {
    positions.push_back({FloatValue(p.x), FloatValue(p.y), FloatValue(p.z)});
  }
  const size_t count = positions.size(), stride = sizeof(positions[0]);
  const size_t view = writer.AddVertices(positions.data(), count, stride);
  attributes["POSITION"] = writer.AddPositions(view, positions.data(), count, stride, 0);
  std::vector<uint32_t> indices;
  for (const auto& triangle : part.triangles) {
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  return {{"attributes", std::move(attributes)},
          {"indices", writer.AddIndices(indices)},
          {"material", material}};
}

void AddAtlasNodes(const Scene& scene, const PatchSet& patches, const Atlas& atlas,
                   const std::vector<AtlasPart>& parts, const View& view,
                   const std::function<Json(const AtlasPart&)>& make_primitive, GlbWriter& writer) {
  std::map<int32_t, Json> primitives;  // by instance
  for (const AtlasPart& part : parts) {
    primitives[atlas.placed.surfaces[part.surface].instance].push_back(make_primitive(part));
  }
  for (auto& [instance, list] : primitives) {
    writer.AddMeshNode(patches, scene.instances[instance].node,
                       writer.Add("meshes", {{"primitives", std::move(list)}}));
  }
  writer.AddCamera(view, patches);
}

}  // namespace lambert
