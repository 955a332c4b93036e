#include "tests/trace/closed_rooms.h"

#include <gtest/gtest.h>

namespace lambert {

PatchSet Turned(PatchSet patches) {
  const auto turn = [](double& a, double& b, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const double p = c * a - s * b;
    b = s * a + c * b;
    a = p;
  };
  for (auto& corners : patches.corners) {
    for (Vec3& p : corners) {
      turn(p.x, p.y, 0.7123);
      turn(p.y, p.z, -1.9341);
      turn(p.z, p.x, 0.1117);
    }
  }
  return patches;
}

std::vector<Room> ConvexRooms() {
  const Paint gray{{0.5, 0.5, 0.5}, {1, 1, 1}};
  const auto box = [&](Vec3 high, int n) {
    return PatchesOf(SceneMaker().Box({}, high, true, {gray}, n).Make());
  };
  return {{"cube", box({1, 1, 1}, 1)},
          {"fine cube", box({1, 1, 1}, 20)},
          {"corridor", box({30, 2.5, 2}, 7)},
          {"flat box", box({1, 0.001, 1}, 3)},
          {"sphere", PatchesOf(MakeIcosphere(2, gray))},
          {"fine sphere", PatchesOf(MakeIcosphere(4, gray))}};
}

PatchSet ClosedCornell(int n) {
  Scene scene = MakeCornell(n);
  // Two-sided blocks and lamp: what is shot under and above them meets a side.
  for (const Mesh& mesh : scene.meshes) {
    const bool has_back = mesh.name.find("block") != std::string::npos || mesh.name == "lamp";
    if (!has_back) continue;
    for (const Primitive& part : mesh.primitives) scene.materials[part.material].two_sided = true;
  }
  const Scene front =
      SceneMaker().Quad({0, 0, 2}, {0, 2, 0}, {2, 0, 0}, {{0.5, 0.5, 0.5}, {}}, n).Make();
  Mesh mesh = front.meshes[0];
  mesh.primitives[0].material = 0;
  scene.meshes.push_back(mesh);
  scene.node_names.push_back("front");
  scene.instances.push_back({static_cast<int>(scene.node_names.size()) - 1,
                             static_cast<int>(scene.meshes.size()) - 1,
                             {}});
  return PatchesOf(scene);
}

PatchSet Wedge(double angle_rad, double max_edge_m) {
  const auto h = static_cast<float>(std::tan(angle_rad));
  Primitive prism;
  prism.positions = {{0, 0, 0}, {1, 0, 0}, {1, h, 0}, {0, 0, 1}, {1, 0, 1}, {1, h, 1}};
  prism.triangles = {{0, 1, 2}, {3, 5, 4}, {0, 4, 1}, {0, 3, 4},
                     {0, 2, 5}, {0, 5, 3}, {1, 5, 2}, {1, 4, 5}};
  Scene scene;
  scene.meshes = {{"wedge", {prism}}};
  scene.node_names = {"wedge"};
  scene.instances = {{0, 0, {}}};
  PatchOptions options;
  options.max_edge_m = max_edge_m;
  return *BuildPatches(scene, options);
}

void ExpectNoLoss(const PatchSet& patches, int64_t rays, const std::string& name) {
  const Losses losses = CountLosses(patches, rays);
  EXPECT_GT(losses.rays, rays / 2) << name;
  EXPECT_EQ(losses.escaped, 0) << name << ", of " << losses.rays;
}

}  // namespace lambert
