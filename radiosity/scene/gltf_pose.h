// Meshes at rest: morph targets with their weights, skins with their joints where the file puts
// them.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/transform.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_node.h"

namespace lambert {

// What moves the vertices of a mesh. Plain data; model and worlds outlive it.
struct Pose {
  std::vector<double> weights;           // of the morph targets
  const tinygltf::Skin* skin = nullptr;  // none: vertices stay in the space of their node
  const NodeWorlds* worlds = nullptr;
  Vec3 origin;  // metres, world: vertices of a skinned mesh are relative to it
};

// The pose in which `node` shows `mesh`; the mesh's own without a node (-1). SceneError naming the
// node for a skin that does not exist or has no joints in the scene. Requires: a mesh in range.
absl::StatusOr<Pose> PoseOf(const tinygltf::Model& model, int node, int mesh,
                            const NodeWorlds& worlds);

// What a morph target adds to the vertices of a primitive, times its weight.
struct MorphOffsets {
  double weight;
  AccessorReader offsets;  // x y z of each vertex
};

// What vertex `i` has at rest with all targets added. Requires: i in range of their offsets.
Vec3 Morphed(Vec3 rest, const std::vector<MorphOffsets>& targets, uint32_t i);

// The positions of one primitive in a pose.
class PosedPositions {
 public:
  // `positions`: POSITION of the primitive. SceneError naming `where` for targets, joints and
  // weights that are not of a right type or fewer than positions; SCENE_TOO_LARGE where vertices
  // times targets at work are more than `*moves_left`, from which they are taken. The pose and the
  // model must outlive it.
  static absl::StatusOr<PosedPositions> Open(const tinygltf::Model& model,
                                             const tinygltf::Primitive& gltf, const Pose& pose,
                                             const AccessorReader& positions,
                                             const std::string& where, int64_t* moves_left);

  // Whether anything moves.
  bool moves() const { return !targets_.empty() || pose_->skin != nullptr; }
  // Vertex `i` in the pose; it may be not finite. SceneError for joints that do not exist.
  // Requires: i in range of the positions.
  absl::StatusOr<std::array<float, 3>> At(uint32_t i, const std::string& where) const;
  // Where the joints of vertex `i` turn a direction, not of length 1. Errors and requirements as of
  // At.
  absl::StatusOr<Vec3> Turn(uint32_t i, Vec3 direction, const std::string& where) const;

 private:
  struct Influence {  // four joints a vertex
    AccessorReader joints, weights;
  };
  absl::Status OpenTargets(const tinygltf::Model& model, const tinygltf::Primitive& gltf,
                           const std::string& where, int64_t* moves_left);
  absl::Status OpenSkin(const tinygltf::Model& model, const tinygltf::Primitive& gltf,
                        const std::string& where);
  // `position` where joint `joint` takes it, relative to the origin of the pose.
  absl::StatusOr<Vec3> FollowJoint(int joint, Vec3 position, const std::string& where) const;
  absl::StatusOr<Vec3> Skinned(uint32_t i, Vec3 position, const std::string& where) const;

  const Pose* pose_ = nullptr;
  std::optional<AccessorReader> positions_;
  std::vector<MorphOffsets> targets_;
  std::vector<Influence> influences_;
  std::optional<AccessorReader> inverse_bind_;  // none: identity
};

}  // namespace lambert
