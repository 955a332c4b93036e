#include "tests/support/scenes.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace lambert {
namespace {

constexpr Rgb kWhite{0.75, 0.75, 0.75}, kRed{0.63, 0.06, 0.05}, kGreen{0.14, 0.45, 0.09};

// Where a box has its faces: a corner and the two edges whose cross product points inward.
struct Face {
  Vec3 origin, u, v;
};

std::array<Face, 6> InwardFaces(Vec3 low, Vec3 high) {
  const Vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
  return {
      {{low, y, z}, {low + x, z, y}, {low, z, x}, {low + y, x, z}, {low, x, y}, {low + z, y, x}}};
}

void AppendQuad(const Face& face, int n, Primitive* primitive) {
  const uint32_t first = static_cast<uint32_t>(primitive->positions.size());
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      primitive->positions.push_back(
          ToFloats(face.origin + face.u * (1.0 * i / n) + face.v * (1.0 * j / n)));
    }
  }
  const uint32_t row = n + 1;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const uint32_t a = first + j * row + i, b = a + 1, c = b + row, d = a + row;
      primitive->triangles.push_back({a, b, c});
      primitive->triangles.push_back({a, c, d});
    }
  }
}

int AddMaterial(const Paint& paint, const std::string& name, Scene* scene) {
  Material material;
  material.name = name;
  material.reflectance = paint.reflectance;
  material.luminance = paint.exitance_lm_per_m2 / std::numbers::pi;
  material.two_sided = paint.two_sided;
  scene->materials.push_back(material);
  return static_cast<int>(scene->materials.size()) - 1;
}

void AddMesh(Mesh mesh, Scene* scene) {
  const int index = static_cast<int>(scene->meshes.size());
  scene->node_names.push_back(mesh.name);
  scene->meshes.push_back(std::move(mesh));
  scene->instances.push_back({static_cast<int>(scene->node_names.size()) - 1, index, {}});
}

// A block that stands on the floor, turned about the vertical by `angle_rad`; no bottom.
void AddBlock(Vec3 center, double half_m, double height_m, double angle_rad, int n,
              const std::string& name, SceneMaker* maker) {
  const Vec3 u{half_m * std::cos(angle_rad), 0, half_m * std::sin(angle_rad)};
  const Vec3 w{-u.z, 0, u.x}, up{0, height_m, 0};
  const Paint white{kWhite, {}};
  maker->Quad(center + up - u - w, w * 2, u * 2, white, n, name + " top");
  maker->Quad(center - u - w, up, u * 2, white, n, name + " side 1");
  maker->Quad(center + u - w, up, w * 2, white, n, name + " side 2");
  maker->Quad(center + u + w, up, u * -2, white, n, name + " side 3");
  maker->Quad(center - u + w, up, w * -2, white, n, name + " side 4");
}

}  // namespace

SceneMaker& SceneMaker::Quad(Vec3 origin, Vec3 u, Vec3 v, const Paint& paint, int n,
                             const std::string& name) {
  Mesh mesh{name, std::vector<Primitive>(1)};
  AppendQuad({origin, u, v}, n, &mesh.primitives[0]);
  mesh.primitives[0].material = AddMaterial(paint, name, &scene_);
  AddMesh(std::move(mesh), &scene_);
  return *this;
}

SceneMaker& SceneMaker::Box(Vec3 low, Vec3 high, bool inward, const std::vector<Paint>& paints,
                            int n, const std::string& name) {
  Mesh mesh{name, std::vector<Primitive>(6)};
  const std::array<Face, 6> faces = InwardFaces(low, high);
  for (int k = 0; k < 6; ++k) {
    Face face = faces[k];
    if (!inward) std::swap(face.u, face.v);
    AppendQuad(face, n, &mesh.primitives[k]);
    mesh.primitives[k].material = paints.size() == 1 && k > 0
                                      ? mesh.primitives[0].material
                                      : AddMaterial(paints[k], name, &scene_);
  }
  AddMesh(std::move(mesh), &scene_);
  return *this;
}

SceneMaker& SceneMaker::Light(Vec3 position, Rgb intensity_cd) {
  scene_.lights.push_back({"light", position, intensity_cd});
  return *this;
}

SceneMaker& SceneMaker::LookFrom(Vec3 eye, Vec3 target, double yfov_rad) {
  Camera camera;
  camera.name = "camera";
  camera.yfov_rad = yfov_rad;
  camera.world.z = Normalized(eye - target);
  camera.world.x = Normalized(Cross({0, 1, 0}, camera.world.z));
  camera.world.y = Cross(camera.world.z, camera.world.x);
  camera.world.translation = eye;
  scene_.cameras.push_back(camera);
  return *this;
}

PatchSet PatchesOf(const Scene& scene) {
  absl::StatusOr<PatchSet> patches = BuildPatches(scene, {});
  if (!patches.ok()) {
    std::cerr << "PatchesOf: " << patches.status() << "\n";
    std::abort();
  }
  return *std::move(patches);
}

Scene MakeBox(double edge_m, Rgb reflectance, const std::vector<Rgb>& per_face_lm_per_m2, int n) {
  std::vector<Paint> paints;
  for (const Rgb& exitance : per_face_lm_per_m2) paints.push_back({reflectance, exitance});
  return SceneMaker().Box({}, {edge_m, edge_m, edge_m}, true, paints, n).Make();
}

Scene MakeFurnace(double reflectance, double exitance_lm_per_m2, int n) {
  const double rho = reflectance, e = exitance_lm_per_m2;
  return SceneMaker().Box({}, {1, 1, 1}, true, {{{rho, rho, rho}, {e, e, e}}}, n).Make();
}

Scene MakeJitteredFurnace(double reflectance, double exitance_lm_per_m2, int n) {
  Scene scene = MakeFurnace(reflectance, exitance_lm_per_m2, n);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> shift(-0.2f / static_cast<float>(n),
                                              0.2f / static_cast<float>(n));
  for (Primitive& face : scene.meshes[0].primitives) {
    for (std::array<float, 3>& p : face.positions) {
      // One coordinate is that of the face; with another at an end the vertex is on an edge.
      if (std::count_if(p.begin(), p.end(), [](float x) { return x == 0 || x == 1; }) > 1) continue;
      for (float& x : p) x += x == 0 || x == 1 ? 0 : shift(random);
    }
  }
  return scene;
}

Scene MakeLShapedFurnace(double reflectance, double exitance_lm_per_m2, int n) {
  const double rho = reflectance, e = exitance_lm_per_m2;
  const Paint paint{{rho, rho, rho}, {e, e, e}};
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  SceneMaker maker;
  for (const Vec3& square : {Vec3{0, 0, 0}, x, y}) {
    maker.Quad(square, x, y, paint, n, "floor").Quad(square + z, y, x, paint, n, "ceiling");
  }
  // Around the floor with the room on the left.
  Vec3 at;
  for (const Vec3& step : {x, x, y, x * -1, y, x * -1, y * -1, y * -1}) {
    maker.Quad(at, z, step, paint, n, "wall");
    at = at + step;
  }
  return maker.Make();
}

Scene MakeParallelSquares(double reflectance_a, double reflectance_b) {
  const double a = reflectance_a, b = reflectance_b;
  return SceneMaker()
      .Quad({}, {0, 0, 1}, {1, 0, 0}, {{a, a, a}, {1, 1, 1}}, 1, "a")
      .Quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {{b, b, b}, {}}, 1, "b")
      .Make();
}

Scene MakePerpendicularSquares(double reflectance_a, double reflectance_b) {
  const double a = reflectance_a, b = reflectance_b;
  return SceneMaker()
      .Quad({}, {0, 0, 1}, {1, 0, 0}, {{a, a, a}, {1, 1, 1}}, 1, "a")
      .Quad({}, {1, 0, 0}, {0, 1, 0}, {{b, b, b}, {}}, 1, "b")
      .Make();
}

Scene MakeCornell(int n) {
  const Paint white{kWhite, {}}, lamp{{0.78, 0.78, 0.78}, {53, 37, 19}};
  SceneMaker maker;
  maker.Quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0}, white, n, "floor")
      .Quad({0, 2, 0}, {2, 0, 0}, {0, 0, 2}, white, n, "ceiling")
      .Quad({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, white, n, "back")
      .Quad({0, 0, 0}, {0, 2, 0}, {0, 0, 2}, {kRed, {}}, n, "left")
      .Quad({2, 0, 0}, {0, 0, 2}, {0, 2, 0}, {kGreen, {}}, n, "right")
      .Quad({0.75, 1.99, 0.75}, {0.5, 0, 0}, {0, 0, 0.4}, lamp, n, "lamp");
  AddBlock({1.35, 0, 1.3}, 0.3, 0.6, 0.3, n, "short block", &maker);
  AddBlock({0.65, 0, 0.7}, 0.3, 1.2, -0.3, n, "tall block", &maker);
  return maker.LookFrom({1, 1, 5}, {1, 1, 0}, 0.69).Make();
}

Scene MakeOffice(int n) {
  const Paint white{kWhite, {}}, wood{{0.45, 0.3, 0.2}, {}}, steel{{0.5, 0.5, 0.55}, {}};
  const Paint lamp{{0.8, 0.8, 0.8}, {10000, 9500, 8500}};
  SceneMaker maker;
  maker.Box({}, {6, 3, 8}, true, {white}, 2 * n, "room");
  for (int k = 0; k < 4; ++k) {
    const double x = k % 2 == 0 ? 0.8 : 3.6, z = k < 2 ? 1.0 : 4.5;
    maker.Box({x, 0.7, z}, {x + 1.6, 0.75, z + 0.8}, false, {wood}, n, "desk top");
    maker.Box({x, 0.01, z}, {x + 0.05, 0.69, z + 0.8}, false, {wood}, n, "desk left");
    maker.Box({x + 1.55, 0.01, z}, {x + 1.6, 0.69, z + 0.8}, false, {wood}, n, "desk right");
  }
  maker.Box({0.02, 0.02, 6.5}, {0.4, 2, 7.9}, false, {steel}, n, "shelf");
  maker.Box({5.6, 0.02, 6.5}, {5.98, 1.2, 7.9}, false, {steel}, n, "cupboard");
  for (int k = 0; k < 3; ++k) {
    maker.Quad({2.7, 2.95, 1.2 + 2.4 * k}, {0.6, 0, 0}, {0, 0, 1.2}, lamp, n, "lamp");
  }
  return maker.LookFrom({5.7, 1.8, 7.7}, {1.5, 0.8, 1.5}, 1.0).Make();
}

Scene MakeIcosphere(int splits, const Paint& paint) {
  const double t = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                              {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                              {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  std::vector<std::array<uint32_t, 3>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int k = 0; k < splits; ++k) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      auto [it, is_new] = middles.try_emplace(std::minmax(a, b), points.size());
      if (is_new) points.push_back(points[a] + points[b]);
      return it->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (std::array<uint32_t, 3> f : {std::array{a, ab, ca}, std::array{ab, b, bc},
                                        std::array{ca, bc, c}, std::array{ab, bc, ca}}) {
        finer.push_back(f);
      }
    }
    for (Vec3& p : points) p = Normalized(p);
    faces = std::move(finer);
  }
  Scene scene;
  Mesh mesh{"sphere", std::vector<Primitive>(1)};
  for (const Vec3& p : points) mesh.primitives[0].positions.push_back(ToFloats(Normalized(p)));
  for (const auto& [a, b, c] : faces) mesh.primitives[0].triangles.push_back({a, c, b});
  mesh.primitives[0].material = AddMaterial(paint, "sphere", &scene);
  AddMesh(std::move(mesh), &scene);
  return scene;
}

}  // namespace lambert
