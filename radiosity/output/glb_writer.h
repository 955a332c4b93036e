// Puts the JSON and the binary parts of a GLB file together. For the files that write one.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/vec3.h"
#include "radiosity/output/view.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Indices are those of the file's lists. Not for several threads.
class GlbWriter {
 public:
  using Json = nlohmann::json;
  enum class Type { kFloat, kUnsignedShort };  // of components; unsigned short is normalised

  // An empty scene with `asset`.
  GlbWriter();

  Json& root() { return root_; }
  size_t Add(const char* list, Json item);
  // At the top of the scene.
  void AddNode(Json node);
  // A node that shows `mesh` at the patch set's origin, named after the source's node.
  void AddMeshNode(const PatchSet& patches, int32_t source_node, size_t mesh);
  // A node `view` where the picture was taken.
  void AddCamera(const View& view, const PatchSet& patches);
  // Names an extension in `extensionsUsed`.
  void UseExtension(const std::string& name);
  // KHR_materials_unlit, as it is named in the file's extensions.
  Json UnlitMaterial(const std::string& name);

  // A buffer view of `count` records of `stride` bytes.
  size_t AddVertices(const void* records, size_t count, size_t stride);
  // Accessors of a view that AddVertices made: `components` numbers at `offset` of each record.
  size_t AddAttribute(size_t view, size_t offset, Type type, int components, size_t count);
  // The same for POSITION: float VEC3, with the range that glTF demands.
  size_t AddPositions(size_t view, const void* records, size_t count, size_t stride, size_t offset);
  // A view and an accessor of N floats a vertex.
  template <size_t N>
  size_t AddFloats(const std::vector<std::array<float, N>>& values) {
    const size_t view = AddVertices(values.data(), values.size(), sizeof(std::array<float, N>));
    return AddAttribute(view, 0, Type::kFloat, N, values.size());
  }
  size_t AddIndices(const std::vector<uint32_t>& indices);
  // An image of its own bytes, and one with a texture that shows it.
  size_t AddImage(const std::string& bytes, const std::string& mime_type);
  size_t AddTexture(const std::string& bytes, const std::string& mime_type, const Json& sampler);
  // A view of bytes as they are.
  size_t AddBytes(const std::string& bytes);

  // The file. RESOURCE_EXHAUSTED (reason OUTPUT_TOO_LARGE) over the 4 GiB of its format.
  absl::StatusOr<std::string> Finish();

 private:
  size_t AddView(const void* data, size_t size, int target, size_t stride);

  Json root_;
  std::string binary_;
};

}  // namespace lambert
