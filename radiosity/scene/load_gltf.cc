#include "radiosity/scene/load_gltf.h"

#include <exception>
#include <nlohmann/json.hpp>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_amend.h"
#include "radiosity/scene/gltf_appearance.h"
#include "radiosity/scene/gltf_check.h"
#include "radiosity/scene/gltf_container.h"
#include "radiosity/scene/gltf_draco.h"
#include "radiosity/scene/gltf_extensions.h"
#include "radiosity/scene/gltf_image.h"
#include "radiosity/scene/gltf_material.h"
#include "radiosity/scene/gltf_mesh.h"
#include "radiosity/scene/gltf_meshopt.h"
#include "radiosity/scene/gltf_node.h"
#include "radiosity/scene/gltf_parse.h"
#include "radiosity/scene/light_files.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {
namespace {

absl::Status TooLarge(const std::string& where, const std::string& message) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", where, message, "give a smaller scene"});
}

// The same error with the file's name before where it happened.
absl::Status InFile(const std::string& name, const absl::Status& status) {
  std::optional<ErrorDetail> detail = GetErrorDetail(status);
  if (!detail) return status;
  detail->where = absl::StrCat(name, ", ", detail->where);
  return MakeError(status.code(), *detail);
}

absl::Status CheckBytes(const SceneBundle& bundle, const SceneLimits& limits) {
  uint64_t bytes = bundle.main_bytes.size();
  for (const auto& [uri, file] : bundle.files) bytes += file.size();
  if (bytes <= static_cast<uint64_t>(limits.bytes)) return absl::OkStatus();
  return TooLarge("scene", absl::StrCat(bytes, " bytes, more than ", limits.bytes));
}

int64_t TriangleCount(const Mesh& mesh) {
  int64_t triangles = 0;
  for (const Primitive& primitive : mesh.primitives) {
    triangles += static_cast<int64_t>(primitive.triangles.size());
  }
  return triangles;
}

// True where a node shows its mesh otherwise than others do.
bool HasOwnPose(const tinygltf::Node& node) { return node.skin >= 0 || !node.weights.empty(); }

// What a primitive weighs in a pose of its own beside its vertices.
constexpr int64_t kPrimitiveMoves = 100;

// Reads the meshes that instances show, each once in its own pose and once more for each node with
// another; more triangles than the limit, counted with instances, are refused.
class MeshReader {
 public:
  MeshReader(const tinygltf::Model& model, const SceneLimits& limits, Keep keep,
             const NodeWorlds& worlds, Scene* scene, UnreadFeatures* unread)
      : model_(model),
        keep_(keep),
        worlds_(worlds),
        scene_(scene),
        unread_(unread),
        read_(model.meshes.size()),
        budget_{limits.triangles, limits.triangles} {}

  absl::Status Read() {
    scene_->meshes.resize(model_.meshes.size());
    int posed_node = -1, posed_mesh = -1;
    for (Instance& instance : scene_->instances) {
      const bool own_pose = HasOwnPose(model_.nodes[instance.node]);
      if (own_pose && instance.node == posed_node) {
        instance.mesh = posed_mesh;
      } else if (own_pose || !read_[instance.mesh]) {
        absl::Status status = ReadFor(own_pose, &instance);
        if (!status.ok()) return status;
        if (own_pose) posed_node = instance.node, posed_mesh = instance.mesh;
        continue;  // reading took its triangles
      }
      budget_.triangles -= TriangleCount(scene_->meshes[instance.mesh]);
      if (budget_.triangles < 0) {
        return TooLarge(absl::StrCat("node ", instance.node),
                        "the scene has more triangles than are allowed");
      }
    }
    return absl::OkStatus();
  }

 private:
  absl::Status ReadFor(bool own_pose, Instance* instance) {
    const int index = instance->mesh;
    const absl::StatusOr<Pose> pose =
        PoseOf(model_, own_pose ? instance->node : -1, index, worlds_);
    if (!pose.ok()) return pose.status();
    if (own_pose) {
      // A copy without triangles takes memory too.
      budget_.moves -=
          kPrimitiveMoves * static_cast<int64_t>(model_.meshes[index].primitives.size());
      if (budget_.moves < 0) {
        return TooLarge(absl::StrCat("node ", instance->node),
                        "the scene has more poses of meshes than are allowed");
      }
    }
    absl::StatusOr<Mesh> mesh =
        ReadMesh(model_, scene_->materials, index, *pose, keep_, &budget_, unread_);
    if (!mesh.ok()) return mesh.status();
    if (pose->skin != nullptr) {
      instance->world = Transform{};
      instance->world.translation = pose->origin;
    }
    if (!own_pose) {
      read_[index] = true;
      scene_->meshes[index] = *std::move(mesh);
      return absl::OkStatus();
    }
    mesh->pose_of = index;
    instance->mesh = static_cast<int>(scene_->meshes.size());
    scene_->meshes.push_back(*std::move(mesh));
    return absl::OkStatus();
  }

  const tinygltf::Model& model_;
  const Keep keep_;
  const NodeWorlds& worlds_;
  Scene* scene_;
  UnreadFeatures* unread_;
  std::vector<bool> read_;  // by mesh of the file
  MeshBudget budget_;
};

// The meshes that instances show.
std::vector<bool> FindShownMeshes(const tinygltf::Model& model, const Scene& scene) {
  std::vector<bool> shown(model.meshes.size());
  for (const Instance& instance : scene.instances) shown[instance.mesh] = true;
  return shown;
}

// Materials of their triangles.
std::vector<bool> FindUsedMaterials(const tinygltf::Model& model, const std::vector<bool>& shown) {
  std::vector<bool> used(model.materials.size());
  for (size_t m = 0; m < shown.size(); ++m) {
    if (!shown[m]) continue;
    for (const tinygltf::Primitive& primitive : model.meshes[m].primitives) {
      const int material = primitive.material;
      if (material >= 0 && material < static_cast<int>(used.size()) &&
          IsTriangleMode(primitive.mode)) {
        used[material] = true;
      }
    }
  }
  return used;
}

void AppendVertexWarnings(Scene* scene) {
  int64_t bad_normals = 0, clamped_colors = 0;
  for (const Mesh& mesh : scene->meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      bad_normals += primitive.bad_normals;
      clamped_colors += primitive.clamped_colors;
    }
  }
  if (bad_normals > 0) {
    scene->warnings.push_back(
        {"BAD_VERTEX_NORMALS",
         absl::StrCat("the vertex normals of ", bad_normals,
                      " triangle(s) are not of length 1 or point to the back; sides come from the "
                      "winding, so nothing was changed")});
  }
  if (clamped_colors > 0) {
    scene->warnings.push_back(
        {"REFLECTANCE_CLAMPED", absl::StrCat("the colours of ", clamped_colors,
                                             " vertices are over 1 and were taken as 1")});
  }
}

absl::StatusOr<Scene> ReadScene(const SceneBundle& bundle, const SceneLimits& limits, Keep keep) {
  absl::Status status = CheckBytes(bundle, limits);
  if (!status.ok()) return status;
  absl::StatusOr<absl::string_view> text = FindJsonText(bundle.main_bytes);
  if (!text.ok()) return text.status();
  absl::StatusOr<std::vector<Warning>> warnings = CheckContainer(bundle.main_bytes);
  if (!warnings.ok()) return warnings.status();
  status = CheckGltf(*text, &*warnings);
  if (!status.ok()) return status;
  absl::StatusOr<tinygltf::Model> model = ParseModel(bundle);
  if (!model.ok()) return model.status();
  Scene scene;
  UnreadFeatures unread;
  status = ReadLightFiles(bundle, &scene);
  if (!status.ok()) return status;
  status = CheckVersionAndExtensions(*model, &unread);
  NodeWorlds worlds;
  if (status.ok()) status = DecodeMeshopt(limits.bytes, &*model);
  if (status.ok()) status = ReadNodes(*model, limits.instances, &scene, &worlds, &unread);
  if (!status.ok()) return status;
  const std::vector<bool> shown = FindShownMeshes(*model, scene);
  status = DecodeDraco(shown, limits.triangles, &*model);
  if (!status.ok()) return status;
  TextureLoader textures(*model, limits, &scene.textures);
  absl::StatusOr<std::vector<Material>> materials =
      ReadMaterials(*model, FindUsedMaterials(*model, shown), &textures, &unread);
  if (!materials.ok()) return materials.status();
  scene.materials = *std::move(materials);
  status = MeshReader(*model, limits, keep, worlds, &scene, &unread).Read();
  if (!status.ok()) return status;
  if (keep == Keep::kAppearance) {
    scene.appearance = std::make_shared<const Appearance>(ReadAppearance(*text, *model));
  }
  if (!model->animations.empty()) unread.Add("animations", "file", "shown at rest");
  scene.warnings = *std::move(warnings);
  for (Warning& warning : unread.Warnings()) scene.warnings.push_back(std::move(warning));
  AppendVertexWarnings(&scene);
  return scene;
}

// The array at the end of a path of names; an empty one where there is none.
nlohmann::json ListAt(const nlohmann::json& gltf, const std::vector<const char*>& path) {
  const nlohmann::json* at = &gltf;
  for (const char* name : path) {
    if (!at->is_object() || !at->contains(name)) return nlohmann::json::array();
    at = &(*at)[name];
  }
  return at->is_array() ? *at : nlohmann::json::array();
}

absl::StatusOr<std::vector<std::string>> ReadExternalUris(const std::string& main_bytes) {
  absl::StatusOr<absl::string_view> text = FindJsonText(main_bytes);
  if (!text.ok()) return text.status();
  const nlohmann::json gltf = nlohmann::json::parse(text->begin(), text->end(), nullptr, false);
  if (!gltf.is_object()) {
    return SceneError("JSON", "it is not a glTF object", "export the file again");
  }
  std::vector<std::string> files;
  const std::vector<std::vector<const char*>> lists = {
      {"buffers"}, {"images"}, {"extensions", "EXT_lights_ies", "lights"}};
  for (const std::vector<const char*>& path : lists) {
    for (const nlohmann::json& item : ListAt(gltf, path)) {
      if (!item.is_object() || !item.contains("uri") || !item["uri"].is_string()) continue;
      if (IsFallbackBuffer(item)) continue;
      const std::string uri = item["uri"].get<std::string>();
      if (absl::StartsWith(uri, "data:")) continue;
      if (!IsSafeRelativeUri(uri)) {
        return SceneError(
            path.back(),
            absl::StrCat("URI \"", Printable(uri), "\" is not a file beside the scene"),
            "export a GLB with everything inside");
      }
      const std::string file = DecodeUri(uri);
      if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
    }
  }
  return files;
}

}  // namespace

absl::StatusOr<Scene> LoadGltf(const SceneBundle& bundle, const SceneLimits& limits, Keep keep) {
  // Memory can run out anywhere below; nothing else is expected to throw.
  try {
    absl::StatusOr<Scene> scene = ReadScene(bundle, limits, keep);
    if (scene.ok()) return scene;
    return InFile(bundle.main_name, scene.status());
  } catch (const std::exception& exception) {
    return InFile(bundle.main_name,
                  TooLarge("scene", absl::StrCat("it cannot be held: ", exception.what())));
  }
}

absl::StatusOr<std::vector<std::string>> ListExternalFiles(const std::string& main_name,
                                                           const std::string& main_bytes) {
  absl::StatusOr<std::vector<std::string>> files = ReadExternalUris(main_bytes);
  if (files.ok()) return files;
  return InFile(main_name, files.status());
}

}  // namespace lambert
