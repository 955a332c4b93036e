#include "radiosity/scene/gltf_pose.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

// Attribute `name` of `type`, with an element for each of `count` vertices.
absl::StatusOr<AccessorReader> OpenFor(const tinygltf::Model& model, int accessor, int type,
                                       uint64_t count, const std::string& name,
                                       const std::string& where) {
  absl::StatusOr<AccessorReader> made = AccessorReader::Make(model, accessor, type);
  if (made.ok() && made->count() < count) {
    return SceneError(where, absl::StrCat("it has fewer ", name, " than positions"), kExportAgain);
  }
  return made;
}

}  // namespace

absl::StatusOr<Pose> PoseOf(const tinygltf::Model& model, int node, int mesh,
                            const NodeWorlds& worlds) {
  Pose pose;
  pose.weights = model.meshes[mesh].weights;
  pose.worlds = &worlds;
  if (node < 0) return pose;
  const tinygltf::Node& gltf = model.nodes[node];
  if (!gltf.weights.empty()) pose.weights = gltf.weights;
  if (gltf.skin < 0) return pose;
  const std::string where = absl::StrCat("node ", node);
  if (gltf.skin >= static_cast<int>(model.skins.size())) {
    return SceneError(where, absl::StrCat("its skin ", gltf.skin, " does not exist"), kExportAgain);
  }
  pose.skin = &model.skins[gltf.skin];
  for (int joint : pose.skin->joints) {
    if (joint < 0 || joint >= static_cast<int>(worlds.size()) || !worlds[joint]) continue;
    pose.origin = worlds[joint]->translation;
    return pose;
  }
  return SceneError(where, absl::StrCat("its skin ", gltf.skin, " has no joint in the scene"),
                    kExportAgain);
}

Vec3 Morphed(Vec3 rest, const std::vector<MorphOffsets>& targets, uint32_t i) {
  for (const MorphOffsets& target : targets) {
    std::array<float, 3> read;
    target.offsets.Floats(i, read.data());
    rest = rest + FromFloats(read) * target.weight;
  }
  return rest;
}

absl::StatusOr<PosedPositions> PosedPositions::Open(const tinygltf::Model& model,
                                                    const tinygltf::Primitive& gltf,
                                                    const Pose& pose,
                                                    const AccessorReader& positions,
                                                    const std::string& where, int64_t* moves_left) {
  PosedPositions posed;
  posed.pose_ = &pose;
  posed.positions_ = positions;
  absl::Status status = posed.OpenTargets(model, gltf, where, moves_left);
  if (status.ok() && pose.skin != nullptr) status = posed.OpenSkin(model, gltf, where);
  if (!status.ok()) return status;
  return posed;
}

absl::Status PosedPositions::OpenTargets(const tinygltf::Model& model,
                                         const tinygltf::Primitive& gltf, const std::string& where,
                                         int64_t* moves_left) {
  const int64_t vertices = static_cast<int64_t>(positions_->count());
  for (size_t t = 0; t < std::min(gltf.targets.size(), pose_->weights.size()); ++t) {
    const auto found = gltf.targets[t].find("POSITION");
    if (pose_->weights[t] == 0 || found == gltf.targets[t].end()) continue;
    absl::StatusOr<AccessorReader> offsets =
        OpenFor(model, found->second, TINYGLTF_TYPE_VEC3, positions_->count(),
                absl::StrCat("offsets of morph target ", t), where);
    if (!offsets.ok()) return offsets.status();
    *moves_left -= vertices;
    if (*moves_left < 0) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"SCENE_TOO_LARGE", where, "morph targets move more vertices than allowed",
                        "apply the morph targets before export"});
    }
    targets_.push_back({pose_->weights[t], *std::move(offsets)});
  }
  return absl::OkStatus();
}

absl::Status PosedPositions::OpenSkin(const tinygltf::Model& model, const tinygltf::Primitive& gltf,
                                      const std::string& where) {
  for (int set = 0;; ++set) {
    const std::string joints_name = absl::StrCat("JOINTS_", set);
    const std::string weights_name = absl::StrCat("WEIGHTS_", set);
    const auto joints = gltf.attributes.find(joints_name);
    const auto weights = gltf.attributes.find(weights_name);
    if (joints == gltf.attributes.end() || weights == gltf.attributes.end()) break;
    absl::StatusOr<AccessorReader> j =
        OpenFor(model, joints->second, TINYGLTF_TYPE_VEC4, positions_->count(), joints_name, where);
    if (!j.ok()) return j.status();
    absl::StatusOr<AccessorReader> w = OpenFor(model, weights->second, TINYGLTF_TYPE_VEC4,
                                               positions_->count(), weights_name, where);
    if (!w.ok()) return w.status();
    influences_.push_back({*std::move(j), *std::move(w)});
  }
  if (influences_.empty()) {
    return SceneError(where, "its node has a skin, but it has no joints and weights", kExportAgain);
  }
  if (pose_->skin->inverseBindMatrices < 0) return absl::OkStatus();
  absl::StatusOr<AccessorReader> made =
      AccessorReader::Make(model, pose_->skin->inverseBindMatrices, TINYGLTF_TYPE_MAT4);
  if (!made.ok()) return made.status();
  if (made->count() < pose_->skin->joints.size() ||
      made->component_type() != TINYGLTF_COMPONENT_TYPE_FLOAT) {
    return SceneError(where, "its skin has not a matrix of floats for each joint", kExportAgain);
  }
  inverse_bind_ = *std::move(made);
  return absl::OkStatus();
}

absl::StatusOr<Vec3> PosedPositions::FollowJoint(int joint, Vec3 position,
                                                 const std::string& where) const {
  const std::vector<int>& joints = pose_->skin->joints;
  const int node = joint < static_cast<int>(joints.size()) ? joints[joint] : -1;
  if (node < 0 || node >= static_cast<int>(pose_->worlds->size()) || !(*pose_->worlds)[node]) {
    return SceneError(where, absl::StrCat("joint ", joint, " of its skin is not in the scene"),
                      kExportAgain);
  }
  if (inverse_bind_) {
    std::array<float, 16> m;
    inverse_bind_->Floats(joint, m.data());
    const Transform to_joint = {
        {m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    position = to_joint.Point(position);
  }
  Transform world = *(*pose_->worlds)[node];
  world.translation = world.translation - pose_->origin;
  return world.Point(position);
}

absl::StatusOr<Vec3> PosedPositions::Skinned(uint32_t i, Vec3 position,
                                             const std::string& where) const {
  Vec3 sum;
  double total = 0;
  for (const Influence& influence : influences_) {
    std::array<float, 4> joints, weights;
    influence.joints.Floats(i, joints.data());
    influence.weights.Floats(i, weights.data());
    for (int k = 0; k < 4; ++k) {
      if (weights[k] == 0) continue;
      // Joints are unsigned integers of at most 16 bits, but a file may say anything.
      const float joint = std::clamp(joints[k], 0.0f, 65535.0f);
      const absl::StatusOr<Vec3> moved = FollowJoint(static_cast<int>(joint), position, where);
      if (!moved.ok()) return moved.status();
      sum = sum + *moved * weights[k];
      total += weights[k];
    }
  }
  if (total > 0) return sum / total;
  return FollowJoint(0, position, where);
}

absl::StatusOr<Vec3> PosedPositions::Turn(uint32_t i, Vec3 direction,
                                          const std::string& where) const {
  if (pose_->skin == nullptr) return direction;
  const absl::StatusOr<Vec3> to = Skinned(i, direction, where);
  if (!to.ok()) return to.status();
  const absl::StatusOr<Vec3> from = Skinned(i, {}, where);
  return from.ok() ? *to - *from : from;
}

absl::StatusOr<std::array<float, 3>> PosedPositions::At(uint32_t i,
                                                        const std::string& where) const {
  std::array<float, 3> read;
  positions_->Floats(i, read.data());
  if (!moves()) return read;
  Vec3 position = Morphed(FromFloats(read), targets_, i);
  if (pose_->skin != nullptr) {
    const absl::StatusOr<Vec3> skinned = Skinned(i, position, where);
    if (!skinned.ok()) return skinned.status();
    position = *skinned;
  }
  return ToFloats(position);
}

}  // namespace lambert
