// make_room OUT.glb: writes the bundled scene, a furnished dining room with two ceiling luminaires
// and an opal globe. Metres, y up, nit. The file is the same at every run.
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "examples/box_model.h"
#include "examples/glb_writer.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"

namespace lambert::examples {
namespace {

constexpr double kWallEdge_m = 0.24;       // longest patch edge on floor, walls and ceiling
constexpr double kFurnitureEdge_m = 0.22;  // and on furniture
constexpr Vec3 kGlobe{0.21, 0.9, 1.51};    // its centre, .07 m from the wall at x = 0
constexpr double kGlobeRadius_m = 0.14;
constexpr double kWidth_m = 5, kHeight_m = 2.7, kDepth_m = 4;  // x, y, z of the room

// Collects materials, objects and the faces of each.
class RoomBuilder {
 public:
  int Material(const std::string& name, Rgb reflectance, Rgb luminance_nit = {}) {
    scene_.materials.push_back({name, reflectance, luminance_nit});
    return static_cast<int>(scene_.materials.size()) - 1;
  }
  int Object(const std::string& name, int material) {
    scene_.objects.push_back({name, material, {}});
    return static_cast<int>(scene_.objects.size()) - 1;
  }
  void Add(const std::vector<Quad>& quads) {
    for (const Quad& quad : quads) {
      const auto& c = quad.corners;
      AddTriangle(quad.object, {c[0], c[1], c[2]});
      AddTriangle(quad.object, {c[0], c[2], c[3]});
    }
  }
  void AddTriangle(int object, const std::array<Vec3, 3>& triangle) {
    scene_.objects[object].triangles.push_back(triangle);
  }
  GlbScene& scene() { return scene_; }

 private:
  GlbScene scene_;
};

using Boxes = std::vector<Box>;

// Four legs of square section on the corners of [x0, x1] x [z0, z1].
void AddLegs(double x0, double x1, double z0, double z1, double top, double side, int object,
             Boxes& boxes) {
  for (double x : {x0, x1 - side}) {
    for (double z : {z0, z1 - side}) {
      boxes.push_back({{x, 0, z}, {x + side, top, z + side}, object});
    }
  }
}

Boxes Table(int object) {
  Boxes boxes{{{1.4, 0.71, 1.65}, {3.2, 0.75, 2.55}, object}};
  AddLegs(1.5, 3.1, 1.72, 2.48, 0.71, 0.06, object, boxes);
  return boxes;
}

// A chair whose seat spans [x, x + .44] x [z, z + .42]; its back stands on the side of low z, or of
// high z.
Boxes Chair(double x, double z, bool back_at_high_z, int object) {
  const double x1 = x + 0.44, z1 = z + 0.42, side = 0.04;
  Boxes boxes{{{x, 0.43, z}, {x1, 0.47, z1}, object}};
  AddLegs(x, x1, z, z1, 0.43, side, object, boxes);
  const double back = back_at_high_z ? z1 - side : z;
  for (double post : {x, x1 - side}) {
    boxes.push_back({{post, 0.47, back}, {post + side, 0.88, back + side}, object});
  }
  boxes.push_back({{x + side, 0.62, back}, {x1 - side, 0.88, back + side}, object});
  return boxes;
}

// A bookcase against the wall at z = 0, open to the front, with blocks of books. `books`: objects
// of three colours.
Boxes Bookcase(int wood, const std::array<int, 3>& books) {
  const double x0 = 3.3, x1 = 4.5, back = 0.02, depth = 0.3, thickness = 0.03, height = 1.85;
  Boxes boxes{{{x0, 0, 0}, {x1, height, back}, wood},
              {{x0, 0, 0}, {x0 + thickness, height, depth}, wood},
              {{x1 - thickness, 0, 0}, {x1, height, depth}, wood}};
  const std::array<double, 5> boards{0.05, 0.5, 0.95, 1.4, height - thickness};
  for (double y : boards) {
    boxes.push_back({{x0 + thickness, y, back}, {x1 - thickness, y + thickness, depth}, wood});
  }
  struct Block {
    int board;
    double x0, x1, height;
    int colour;
  };
  const Block blocks[] = {{0, 3.33, 3.75, 0.3, 0},  {0, 3.75, 4.05, 0.24, 1},
                          {1, 3.75, 4.05, 0.3, 2},  {1, 4.05, 4.47, 0.24, 0},
                          {2, 3.33, 3.75, 0.24, 1}, {2, 4.05, 4.47, 0.3, 2},
                          {3, 3.33, 3.75, 0.3, 2},  {3, 3.75, 4.05, 0.24, 0}};
  for (const Block& block : blocks) {
    const double y = boards[block.board] + thickness;
    boxes.push_back({{block.x0, y, back}, {block.x1, y + block.height, 0.2}, books[block.colour]});
  }
  return boxes;
}

// A chest of drawers against the wall at x = 0 and what stands on it but for the globe.
Boxes Sideboard(int chest, int foot, int parcel) {
  return {{{0, 0, 1.2}, {0.38, 0.08, 2.8}, chest},
          {{0, 0.08, 1.2}, {0.42, 0.72, 2.8}, chest},
          {{0.15, 0.72, 1.45}, {0.27, 0.76, 1.57}, foot},
          {{0.08, 0.72, 2.3}, {0.34, 0.84, 2.6}, parcel}};
}

// Four bars around a canvas of x0..x1, y0..y1 on the wall at z = 0.
Boxes PictureFrame(double x0, double x1, double y0, double y1, int object) {
  const double bar = 0.05, depth = 0.03;
  return {{{x0 - bar, y0 - bar, 0}, {x1 + bar, y0, depth}, object},
          {{x0 - bar, y1, 0}, {x1 + bar, y1 + bar, depth}, object},
          {{x0 - bar, y0, 0}, {x0, y1, depth}, object},
          {{x1, y0, 0}, {x1 + bar, y1, depth}, object}};
}

// A luminaire on the ceiling: a white tray whose lower face shines but for a rim.
Boxes Luminaire(double x, double z, int tray, int panel) {
  const double length = 1.2, width = 0.4, rim = 0.04, top = kHeight_m;
  return {{{x + rim, top - 0.06, z + rim}, {x + length - rim, top - 0.03, z + width - rim}, panel},
          {{x, top - 0.06, z}, {x + length, top, z + width}, tray}};
}

// An icosahedron whose triangles are divided by 4 `depth` times, corners on the sphere.
void AddSphere(Vec3 centre, double radius_m, int depth, int object, RoomBuilder& room) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Vec3 corners[] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                          {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                          {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                            {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                            {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                            {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& face : faces) {
    triangles.push_back(
        {Normalized(corners[face[0]]), Normalized(corners[face[1]]), Normalized(corners[face[2]])});
  }
  for (int i = 0; i < depth; ++i) {
    std::vector<std::array<Vec3, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const Vec3 ab = Normalized(a + b), bc = Normalized(b + c), ca = Normalized(c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (const auto& [a, b, c] : triangles) {
    room.AddTriangle(object, {centre + a * radius_m, centre + b * radius_m, centre + c * radius_m});
  }
}

// Everything that stands in the room, one list a group of boxes that touch.
std::vector<Boxes> Furnish(RoomBuilder& room) {
  const int oak = room.Material("oak", {0.5, 0.34, 0.2});
  const int walnut = room.Material("walnut", {0.3, 0.19, 0.12});
  const int white = room.Material("white lacquer", {0.82, 0.82, 0.8});
  const int red = room.Material("red cloth", {0.55, 0.12, 0.1});
  const int blue = room.Material("blue cloth", {0.12, 0.22, 0.45});
  const int cream = room.Material("cream cloth", {0.75, 0.68, 0.52});
  const int panel = room.Material("luminaire panel", {0.8, 0.8, 0.8}, {4000, 3850, 3600});
  const std::array<int, 3> books{room.Object("red books", red), room.Object("blue books", blue),
                                 room.Object("cream books", cream)};
  std::vector<Boxes> groups;
  groups.push_back(Table(room.Object("table", walnut)));
  groups.push_back(Chair(1.75, 1.3, false, room.Object("chair at the back", oak)));
  groups.push_back(Chair(2.45, 2.5, true, room.Object("chair at the front", oak)));
  groups.push_back(Bookcase(room.Object("bookcase", white), books));
  groups.push_back(Sideboard(room.Object("sideboard", oak), room.Object("globe foot", walnut),
                             room.Object("parcel", red)));
  groups.push_back(PictureFrame(1.4, 2.6, 1.3, 2.1, room.Object("picture frame", walnut)));
  for (double x : {0.9, 2.9}) {
    const std::string name = x < 2 ? "left luminaire" : "right luminaire";
    const int tray = room.Object(name + " tray", white);
    groups.push_back(Luminaire(x, 1.8, tray, room.Object(name, panel)));
  }
  return groups;
}

// The six walls, and what lies flush in them: rug, canvas and door.
void AddRoom(const std::vector<Boxes>& groups, RoomBuilder& room) {
  const int plaster = room.Object("back wall", room.Material("white plaster", {0.78, 0.76, 0.72}));
  const int front = room.Object("front wall", room.scene().objects[plaster].material);
  const int left = room.Object("left wall", room.Material("green plaster", {0.3, 0.5, 0.4}));
  const int right = room.Object("right wall", room.Material("ochre plaster", {0.74, 0.5, 0.26}));
  const int floor = room.Object("floor", room.Material("parquet", {0.42, 0.29, 0.18}));
  const int ceiling = room.Object("ceiling", room.Material("white ceiling", {0.85, 0.85, 0.84}));
  const int rug = room.Object("rug", room.Material("rug", {0.58, 0.5, 0.42}));
  const int sky = room.Object("canvas sky", room.Material("painted sky", {0.35, 0.55, 0.75}));
  const int field = room.Object("canvas field", room.Material("painted field", {0.6, 0.55, 0.2}));
  const int door = room.Object("door", room.Material("grey door", {0.55, 0.56, 0.55}));
  const Room walls{
      {0, 0, 0}, {kWidth_m, kHeight_m, kDepth_m}, {left, right, floor, ceiling, plaster, front}};
  Boxes paint{{{1.1, 0, 1.2}, {3.5, 0, 3}, rug},
              {{1.4, 1.6, 0}, {2.6, 2.1, 0}, sky},
              {{1.4, 1.3, 0}, {2.6, 1.6, 0}, field},
              {{kWidth_m, 0, 1.2}, {kWidth_m, 2.1, 2.1}, door}};
  // The wall behind the globe in finer patches: its light falls off within centimetres there.
  for (double reach_m : {0.06, 0.13, 0.21, 0.32}) {
    paint.push_back({{0, kGlobe.y - reach_m, kGlobe.z - reach_m},
                     {0, kGlobe.y + reach_m, kGlobe.z + reach_m},
                     left});
  }
  Boxes all;
  for (const Boxes& group : groups) {
    room.Add(BoxFaces(group, walls, kFurnitureEdge_m));
    all.insert(all.end(), group.begin(), group.end());
  }
  room.Add(RoomFaces(walls, all, paint, kWallEdge_m));
}

GlbScene MakeRoom() {
  RoomBuilder room;
  AddRoom(Furnish(room), room);
  const int opal = room.Material("opal glass", {0.8, 0.8, 0.8}, {1500, 1100, 700});
  AddSphere(kGlobe, kGlobeRadius_m, 2, room.Object("globe", opal), room);
  GlbScene& scene = room.scene();
  scene.name = "room";
  scene.copyright = "CC0 1.0: the Lambert authors dedicate this scene to the public domain";
  scene.camera = {"camera", {4.75, 1.6, 3.85}, {1.95, 1.02, 0.9}, 0.95, 1.5};
  return scene;
}

}  // namespace
}  // namespace lambert::examples

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_room OUT.glb\n", stderr);
    return 2;
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << lambert::examples::EncodeGlb(lambert::examples::MakeRoom());
  file.close();
  if (!file) {
    std::fprintf(stderr, "error: %s: cannot be written; choose another path\n", argv[1]);
    return 1;
  }
  return 0;
}
