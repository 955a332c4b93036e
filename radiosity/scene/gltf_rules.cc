#include "radiosity/scene/gltf_rules.h"

namespace lambert {
namespace {

constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr double kLargestFloat = std::numeric_limits<float>::max();
constexpr double kHalfPi = 1.5707963267948966;

constexpr GltfRule Integer(const char* object, const char* property, double least, double most) {
  return {object, property, GltfKind::kInteger, "", least, most};
}
constexpr GltfRule Number(const char* object, const char* property, double least = -kAny,
                          double most = kAny) {
  return {object, property, GltfKind::kNumber, "", least, most};
}
constexpr GltfRule Numbers(const char* object, const char* property, int count,
                           double least = -kAny, double most = kAny) {
  return {object, property, GltfKind::kNumbers, "", least, most, count};
}
constexpr GltfRule Of(GltfKind kind, const char* object, const char* property,
                      const char* target = "") {
  return {object, property, kind, target};
}
constexpr GltfRule Required(GltfRule rule) {
  rule.required = true;
  return rule;
}

using enum GltfKind;

constexpr GltfRule kRules[] = {
    Required(Of(kObject, "glTF", "asset", "asset")),
    Of(kIndex, "glTF", "scene", "scene"),
    Of(kObjects, "glTF", "scenes", "scene"),
    Of(kObjects, "glTF", "nodes", "node"),
    Of(kObjects, "glTF", "meshes", "mesh"),
    Of(kObjects, "glTF", "materials", "material"),
    Of(kObjects, "glTF", "textures", "texture"),
    Of(kObjects, "glTF", "images", "image"),
    Of(kObjects, "glTF", "samplers", "sampler"),
    Of(kObjects, "glTF", "accessors", "accessor"),
    Of(kObjects, "glTF", "buffers", "buffer"),  // before the views, whose ends it bounds
    Of(kObjects, "glTF", "bufferViews", "buffer view"),
    Of(kObjects, "glTF", "cameras", "camera"),
    Of(kObjects, "glTF", "skins", "skin"),
    Of(kObjects, "glTF", "animations", "animation"),
    Of(kTexts, "glTF", "extensionsUsed"),
    Of(kTexts, "glTF", "extensionsRequired"),
    Required(Of(kText, "asset", "version")),
    Of(kText, "asset", "minVersion"),

    Of(kIndices, "scene", "nodes", "node"),
    Of(kIndices, "node", "children", "node"),
    Of(kIndex, "node", "mesh", "mesh"),
    Of(kIndex, "node", "camera", "camera"),
    Of(kIndex, "node", "skin", "skin"),
    Of(kText, "node", "name"),
    Numbers("node", "matrix", 16),
    Numbers("node", "translation", 3),
    Numbers("node", "rotation", 4, -1, 1),
    Numbers("node", "scale", 3),
    Numbers("node", "weights", 0),

    Required(Of(kObjects, "mesh", "primitives", "primitive")),
    Numbers("mesh", "weights", 0),
    Required(Of(kIndexMap, "primitive", "attributes", "accessor")),
    Of(kIndexMaps, "primitive", "targets", "accessor"),
    Of(kIndex, "primitive", "indices", "accessor"),
    Of(kIndex, "primitive", "material", "material"),
    Integer("primitive", "mode", 0, 6),

    Of(kObject, "material", "pbrMetallicRoughness", "metallic roughness"),
    Of(kObject, "material", "normalTexture", "texture info"),
    Of(kObject, "material", "occlusionTexture", "texture info"),
    Of(kObject, "material", "emissiveTexture", "texture info"),
    Numbers("material", "emissiveFactor", 3, 0, 1),
    Of(kText, "material", "alphaMode"),
    Number("material", "alphaCutoff", 0),
    Of(kBool, "material", "doubleSided"),
    Numbers("metallic roughness", "baseColorFactor", 4, 0),
    Number("metallic roughness", "metallicFactor", 0, 1),
    Number("metallic roughness", "roughnessFactor", 0, 1),
    Of(kObject, "metallic roughness", "baseColorTexture", "texture info"),
    Of(kObject, "metallic roughness", "metallicRoughnessTexture", "texture info"),
    Required(Of(kIndex, "texture info", "index", "texture")),
    Integer("texture info", "texCoord", 0, kAny),
    Number("texture info", "strength", 0, 1),

    Of(kIndex, "texture", "source", "image"),
    Of(kIndex, "texture", "sampler", "sampler"),
    Of(kIndex, "image", "bufferView", "buffer view"),
    Of(kText, "image", "uri"),
    Of(kText, "image", "mimeType"),

    Of(kIndex, "accessor", "bufferView", "buffer view"),
    Integer("accessor", "byteOffset", 0, kAny),
    Required(Integer("accessor", "componentType", 0, kAny)),
    Required(Integer("accessor", "count", 1, kAny)),
    Required(Of(kText, "accessor", "type")),
    Of(kBool, "accessor", "normalized"),
    Of(kObject, "accessor", "sparse", "sparse part"),
    Required(Integer("sparse part", "count", 1, kAny)),
    Required(Of(kObject, "sparse part", "indices", "sparse indices")),
    Required(Of(kObject, "sparse part", "values", "sparse values")),
    Required(Of(kIndex, "sparse indices", "bufferView", "buffer view")),
    Integer("sparse indices", "byteOffset", 0, kAny),
    Required(Of(kIndex, "sparse values", "bufferView", "buffer view")),
    Integer("sparse values", "byteOffset", 0, kAny),
    Required(Of(kIndex, "buffer view", "buffer", "buffer")),
    Integer("buffer view", "byteOffset", 0, kAny),
    Required(Integer("buffer view", "byteLength", 1, kAny)),
    Integer("buffer view", "byteStride", 4, 252),
    Required(Integer("buffer", "byteLength", 1, kAny)),
    Of(kText, "buffer", "uri"),

    Required(Of(kText, "camera", "type")),
    Of(kObject, "camera", "perspective", "perspective"),
    Of(kObject, "camera", "orthographic", "orthographic"),
    Required(Number("perspective", "yfov", 0)),
    Required(Number("perspective", "znear", 0)),
    Number("perspective", "zfar", 0),
    Number("perspective", "aspectRatio", 0),
    Required(Number("orthographic", "xmag")),
    Required(Number("orthographic", "ymag")),
    Required(Number("orthographic", "znear", 0)),
    Required(Number("orthographic", "zfar", 0)),

    Required(Of(kIndices, "skin", "joints", "node")),
    Of(kIndex, "skin", "skeleton", "node"),
    Of(kIndex, "skin", "inverseBindMatrices", "accessor"),
    Required(Of(kObjects, "animation", "channels", "channel")),
    Required(Of(kObjects, "animation", "samplers", "animation sampler")),
    Required(Of(kIndex, "animation sampler", "input", "accessor")),
    Required(Of(kIndex, "animation sampler", "output", "accessor")),
    Required(Integer("channel", "sampler", 0, kAny)),
    Required(Of(kObject, "channel", "target", "channel target")),
    Of(kIndex, "channel target", "node", "node"),
    Required(Of(kText, "channel target", "path")),

    Required(Of(kObjects, "lights", "lights", "light")),
    Required(Of(kIndex, "node light", "light", "light")),
    Required(Of(kText, "light", "type")),
    Numbers("light", "color", 3, 0, 1),
    Number("light", "intensity", 0, kLargestFloat),
    Number("light", "range", 0),
    Of(kObject, "light", "spot", "spot"),
    Number("spot", "innerConeAngle", 0, kHalfPi),
    Number("spot", "outerConeAngle", 0, kHalfPi),
    Number("emissive strength", "emissiveStrength", 0, kLargestFloat),
    Numbers("texture transform", "offset", 2),
    Number("texture transform", "rotation"),
    Numbers("texture transform", "scale", 2),
    Integer("texture transform", "texCoord", 0, kAny),
    Of(kIndex, "texture source", "source", "image"),
    Number("dispersion", "dispersion", 0),
    Number("transmission", "transmissionFactor", 0, 1),
    Number("specular", "specularFactor", 0, 1),
    Numbers("specular", "specularColorFactor", 3, 0),
    Numbers("specular glossiness", "diffuseFactor", 4, 0),
    Numbers("specular glossiness", "specularFactor", 3, 0, 1),
    Number("specular glossiness", "glossinessFactor", 0, 1),
    Of(kObject, "specular glossiness", "diffuseTexture", "texture info"),
    Of(kObject, "specular glossiness", "specularGlossinessTexture", "texture info"),
    Number("volume", "thicknessFactor", 0),
};

constexpr GltfPlace kPlaces[] = {
    {"EXT_lights_ies", "glTF", ""},
    {"EXT_lights_ies", "node", ""},
    {"EXT_mesh_gpu_instancing", "node", ""},
    {"EXT_meshopt_compression", "buffer", ""},
    {"EXT_meshopt_compression", "buffer view", ""},
    {"EXT_texture_webp", "texture", "texture source"},
    {"KHR_draco_mesh_compression", "primitive", ""},
    {"KHR_lights_punctual", "glTF", "lights"},
    {"KHR_lights_punctual", "node", "node light"},
    {"KHR_materials_anisotropy", "material", ""},
    {"KHR_materials_clearcoat", "material", ""},
    {"KHR_materials_dispersion", "material", "dispersion"},
    {"KHR_materials_emissive_strength", "material", "emissive strength"},
    {"KHR_materials_ior", "material", ""},
    {"KHR_materials_iridescence", "material", ""},
    {"KHR_materials_pbrSpecularGlossiness", "material", "specular glossiness"},
    {"KHR_materials_sheen", "material", ""},
    {"KHR_materials_specular", "material", "specular"},
    {"KHR_materials_transmission", "material", "transmission"},
    {"KHR_materials_unlit", "material", ""},
    {"KHR_materials_variants", "glTF", ""},
    {"KHR_materials_variants", "primitive", ""},
    {"KHR_materials_volume", "material", "volume"},
    {"KHR_mesh_quantization", "", ""},
    {"KHR_texture_basisu", "texture", "texture source"},
    {"KHR_texture_transform", "texture info", "texture transform"},
};

}  // namespace

std::span<const GltfRule> GltfRules() { return kRules; }
std::span<const GltfPlace> GltfPlaces() { return kPlaces; }

}  // namespace lambert
