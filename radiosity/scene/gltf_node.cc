#include "radiosity/scene/gltf_node.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"
#include "radiosity/scene/gltf_extensions.h"
#include "radiosity/scene/gltf_forest.h"
#include "radiosity/scene/gltf_ies.h"
#include "radiosity/scene/gltf_light.h"
#include "radiosity/scene/gltf_transform.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

absl::Status NodeError(int node, const std::string& message) {
  return SceneError(absl::StrCat("node ", node), message, kExportAgain);
}

// A name of bounded size that is still UTF-8: names go into every report and message.
std::string ShortName(const std::string& name, UnreadFeatures* unread) {
  constexpr size_t kMostBytes = 256;
  if (name.size() <= kMostBytes) return name;
  unread->Add("names longer than 256 bytes", "name", "cut");
  size_t end = kMostBytes;
  while (end > 0 && (name[end] & 0xc0) == 0x80) --end;  // not inside a character
  return name.substr(0, end);
}

// The axes of a camera or light, orthonormal and right-handed; nullopt where scales of zero left
// none.
std::optional<Transform> Orthonormal(const Transform& world) {
  Transform axes = world;
  axes.z = Normalized(world.z);
  axes.x = Normalized(Cross(world.y, axes.z));
  axes.y = Cross(axes.z, axes.x);
  if (!IsFinite(axes)) return std::nullopt;
  return axes;
}

std::optional<Camera> ReadCamera(const tinygltf::Camera& gltf, const Transform& world) {
  Camera camera;
  const std::optional<Transform> axes = Orthonormal(world);
  if (!axes) return std::nullopt;
  camera.world = *axes;
  if (gltf.type == "orthographic") {
    camera.perspective = false;
    camera.half_height_m = std::fabs(gltf.orthographic.ymag);
    camera.aspect = std::fabs(gltf.orthographic.xmag) / camera.half_height_m;
    if (!(camera.half_height_m > 0) || !(camera.aspect > 0)) return std::nullopt;
  } else {
    camera.yfov_rad = gltf.perspective.yfov;
    camera.aspect = gltf.perspective.aspectRatio;
    if (!(camera.yfov_rad > 0) || camera.yfov_rad >= std::numbers::pi) return std::nullopt;
    if (!(camera.aspect >= 0)) camera.aspect = 0;
  }
  if (!std::isfinite(camera.aspect) || !std::isfinite(camera.half_height_m)) return std::nullopt;
  return camera;
}

// Walks the default scene, parents before children, and collects what its nodes show.
class NodeWalker {
 public:
  NodeWalker(const tinygltf::Model& model, int64_t most_instances, Scene* scene, NodeWorlds* worlds,
             UnreadFeatures* unread)
      : model_(model),
        most_instances_(most_instances),
        scene_(scene),
        worlds_(worlds),
        unread_(unread),
        ies_lamps_(model, *scene) {
    worlds_->resize(model.nodes.size());
    scene_->node_axes.resize(model.nodes.size());
  }

  absl::Status Walk(const std::vector<int>& roots) {
    std::vector<std::pair<int, Transform>> open;  // node and its parent's world transform
    for (auto it = roots.rbegin(); it != roots.rend(); ++it) open.push_back({*it, {}});
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      absl::StatusOr<Transform> local = LocalTransform(model_.nodes[node], node);
      if (!local.ok()) return local.status();
      const Transform world = parent * *local;
      if (!IsFinite(world)) return NodeError(node, "its world transform is not finite");
      (*worlds_)[node] = world;
      scene_->node_axes[node] = Orthonormal(world);
      absl::Status status = Show(node, world);
      if (!status.ok()) return status;
      for (int child : model_.nodes[node].children) open.push_back({child, world});
    }
    std::stable_sort(scene_->instances.begin(), scene_->instances.end(),
                     [](const Instance& a, const Instance& b) { return a.node < b.node; });
    return absl::OkStatus();
  }

 private:
  absl::Status Show(int node, const Transform& world) {
    const tinygltf::Node& gltf = model_.nodes[node];
    if (gltf.mesh >= static_cast<int>(model_.meshes.size()) || gltf.mesh < -1) {
      return NodeError(node, absl::StrCat("its mesh ", gltf.mesh, " does not exist"));
    }
    absl::Status status = gltf.mesh >= 0 ? ShowMesh(node, world) : absl::OkStatus();
    if (status.ok()) status = ShowCamera(node, world);
    if (status.ok()) status = ShowLight(node, world);
    return status.ok() ? ShowLamp(node) : status;
  }

  absl::Status ShowMesh(int node, const Transform& world) {
    const tinygltf::Node& gltf = model_.nodes[node];
    if (gltf.skin >= 0) {  // its joints say where it is: PosedMesh
      scene_->instances.push_back({node, gltf.mesh, world});
      return absl::OkStatus();
    }
    const int64_t left = most_instances_ - static_cast<int64_t>(scene_->instances.size());
    absl::StatusOr<std::vector<Transform>> instances = InstanceTransforms(model_, node, left);
    if (!instances.ok()) return instances.status();
    for (const Transform& local : *instances) {
      scene_->instances.push_back({node, gltf.mesh, world * local});
      if (!IsFinite(scene_->instances.back().world)) {
        return NodeError(node, "the transform of an instance is not finite");
      }
    }
    return absl::OkStatus();
  }

  absl::Status ShowCamera(int node, const Transform& world) {
    const tinygltf::Node& gltf = model_.nodes[node];
    if (gltf.camera == -1) return absl::OkStatus();
    if (gltf.camera < -1 || gltf.camera >= static_cast<int>(model_.cameras.size())) {
      return NodeError(node, absl::StrCat("its camera ", gltf.camera, " does not exist"));
    }
    std::optional<Camera> camera = ReadCamera(model_.cameras[gltf.camera], world);
    if (!camera) {
      unread_->Add("cameras without a usable lens or axes", "camera", "left out");
      return absl::OkStatus();
    }
    camera->name =
        ShortName(gltf.name.empty() ? model_.cameras[gltf.camera].name : gltf.name, unread_);
    scene_->cameras.push_back(*std::move(camera));
    return absl::OkStatus();
  }

  absl::Status ShowLight(int node, const Transform& world) {
    const tinygltf::Node& gltf = model_.nodes[node];
    absl::StatusOr<double> index =
        ExtensionNumber(gltf.extensions_json_string, "KHR_lights_punctual", "light", -1,
                        absl::StrCat("node ", node));
    if (!index.ok()) return index.status();
    if (*index == -1) return absl::OkStatus();
    if (!(*index >= 0) || *index >= static_cast<double>(model_.lights.size())) {
      return NodeError(node, absl::StrCat("its light ", *index, " does not exist"));
    }
    const tinygltf::Light& from = model_.lights[static_cast<size_t>(*index)];
    absl::StatusOr<std::optional<Light>> light =
        ReadLight(from, world.translation, scene_->node_axes[node], absl::StrCat("node ", node));
    if (!light.ok()) return light.status();
    if (!*light) {
      unread_->Add("spot and directional lights without axes", "node", "left out");
      return absl::OkStatus();
    }
    (*light)->node = node;
    (*light)->name = ShortName(gltf.name.empty() ? from.name : gltf.name, unread_);
    scene_->lights.push_back(**std::move(light));
    return absl::OkStatus();
  }

  absl::Status ShowLamp(int node) {
    absl::StatusOr<std::optional<Light>> lamp =
        ies_lamps_.At(node, scene_->node_axes[node], absl::StrCat("node ", node));
    if (!lamp.ok()) return lamp.status();
    if (!*lamp) return absl::OkStatus();
    (*lamp)->node = node;
    (*lamp)->name = ShortName(model_.nodes[node].name, unread_);
    scene_->lights.push_back(**std::move(lamp));
    return absl::OkStatus();
  }

  const tinygltf::Model& model_;
  const int64_t most_instances_;
  Scene* scene_;
  NodeWorlds* worlds_;
  UnreadFeatures* unread_;
  IesLamps ies_lamps_;
};

}  // namespace

absl::Status ReadNodes(const tinygltf::Model& model, int64_t most_instances, Scene* scene,
                       NodeWorlds* worlds, UnreadFeatures* unread) {
  std::vector<int> roots;
  absl::Status status = FindRoots(model, &roots);
  if (!status.ok()) return status;
  for (const tinygltf::Node& node : model.nodes) {
    scene->node_names.push_back(ShortName(node.name, unread));
  }
  return NodeWalker(model, most_instances, scene, worlds, unread).Walk(roots);
}

}  // namespace lambert
