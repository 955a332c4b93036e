// A scene as it was modelled: the result of reading a glTF file, before it is cut into patches.
// Plain data; indices refer to the vectors of the same Scene; -1 means none.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/core/transform.h"
#include "radiosity/core/warning.h"
#include "radiosity/scene/ies.h"
#include "radiosity/scene/sphere_table.h"

namespace lambert {

// An 8-bit RGBA image as the file stores it (sRGB encoded), rows from top to bottom.
struct Texture {
  enum class Wrap { kRepeat, kMirroredRepeat, kClampToEdge };
  int width = 0, height = 0;  // pixels
  std::vector<uint8_t> rgba;  // width * height * 4
  Wrap wrap_u = Wrap::kRepeat, wrap_v = Wrap::kRepeat;
};

// A texture and where a surface meets it: at (row_u . (u, v, 1), row_v . (u, v, 1)) for a vertex
// whose TEXCOORD_n is (u, v).
struct TextureUse {
  int texture = -1;                                      // index into Scene::textures
  int uv_set = 0;                                        // n
  std::array<double, 3> row_u{1, 0, 0}, row_v{0, 1, 0};  // KHR_texture_transform
};

struct Material {
  std::string name;
  Rgb reflectance{1, 1, 1};  // baseColorFactor, 0..1, multiplies texture and vertex colours
  TextureUse reflectance_texture;
  Rgb luminance;  // emissiveFactor * emissiveStrength, in the file's unit (nit)
  TextureUse luminance_texture;
  bool two_sided = false;
  bool blend = false;  // alpha mode BLEND
  // Alpha mode MASK: where alpha times those of the reflectance texture and the vertex colours is
  // under the cutoff, there is no surface. 0: nothing is cut.
  double alpha_cutoff = 0;
  double alpha = 1;  // baseColorFactor
};

struct Primitive {
  std::vector<std::array<float, 3>> positions;     // local coordinates
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise seen from the front
  // By n, one of each vertex: TEXCOORD_0 and _1 where they are there, and those of its textures.
  std::map<int, std::vector<std::array<float, 2>>> uv;
  std::vector<std::array<float, 4>> colors;  // COLOR_0: linear RGBA, 0..1; empty: white, opaque
  // Of each vertex, where the appearance is kept; empty where the file has none that can be used.
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 4>> tangents;  // w: 1 or -1, the side of the bitangent
  int material = -1;                           // -1: the glTF default material
  int64_t bad_normals = 0;                     // triangles (VertexNormals); a warning's
  int64_t clamped_colors = 0;                  // vertices with a colour over 1; a warning's
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;  // index = index in the file, also where nothing was read
  int pose_of = -1;  // the mesh of the file that one node shows in a pose of its own; -1: itself
};

// A node that shows a mesh.
struct Instance {
  int node = 0;  // index of the node in the file
  int mesh = 0;  // index into Scene::meshes
  Transform world;
};

struct Camera {
  std::string name;
  Transform world;  // looks along -z, +y up; orthonormal
  bool perspective = true;
  double yfov_rad = 0.8;     // perspective: full vertical angle
  double half_height_m = 1;  // orthographic: half of the visible height
  double aspect = 1.5;       // width / height; 0 where the file leaves it open
};

// A light without a surface.
struct Light {
  enum class Kind : uint8_t {
    kPoint = 0,    // from a place, the same all around or in a cone
    kDistant = 1,  // parallel, from outside the scene
    kLamp = 2,     // from a place, by a table of intensity
    kSky = 3,      // from all around the scene, by a table of luminance
  };
  std::string name;
  Vec3 position;  // kPoint, kLamp: metres, world
  Rgb strength;   // kPoint: intensity inside the cone [cd]; kDistant: illuminance of a surface that
                  // faces the light [lx]; with a table: factor of its values, in cd or nit
  Kind kind = Kind::kPoint;
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  // orthonormal; z: where it shines, or a table's pole
  // kPoint: the cone, by the cosine of the angle to z. Intensity is whole from cos_inner on, none
  // under cos_outer, and falls by the square of the part of the way in between. All around: -1, -1.
  // cos_inner may be over 1: then it is nowhere whole.
  double cos_inner = -1, cos_outer = -1;
  std::shared_ptr<const SphereTable> table = nullptr;  // kLamp, kSky
  int node = -1;  // that it stands at in the file; no part of a patch set
};
inline bool HasPlace(const Light& light) {
  return light.kind == Light::Kind::kPoint || light.kind == Light::Kind::kLamp;
}
inline bool HasTable(const Light& light) {
  return light.kind == Light::Kind::kLamp || light.kind == Light::Kind::kSky;
}

// How the surfaces of a file look beside what they reflect diffusely and emit: to be passed on.
struct Appearance {
  // Lists `materials`, `textures`, `samplers` and `images` as the file has them, in a JSON object;
  // but images are {name, mimeType}.
  std::string json;
  std::vector<std::string> images;  // encoded, by image; empty where there is none to be had
};

struct Scene {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;             // those of the file, then poses of them
  std::vector<Instance> instances;      // of the default scene, in node order
  std::vector<std::string> node_names;  // by node index; "" where the file gives none
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  // By node: its axes, orthonormal, and its place; none for nodes without, or not in the scene.
  std::vector<std::optional<Transform>> node_axes;
  // Of the files beside the scene, by name: lamps (.ies) and sky maps.
  std::map<std::string, LampProfile> lamps;
  std::map<std::string, std::shared_ptr<const SphereTable>> skies;
  std::shared_ptr<const Appearance> appearance;  // null where it is not kept
  std::vector<Warning> warnings;
};

}  // namespace lambert
