// The files of Khronos' glTF-Asset-Generator, by numbers: what each group is about, worked out from
// the generator's descriptions, or by a program of its own from the file's raw data (the means of
// pictures, the solid's sums). Skipped where the files are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "tests/scene/corpus.h"

namespace lambert {
namespace {

// What the patches of one node are together.
struct Shape {
  int patches = 0;  // 0: neither they nor their box are told
  double area_m2 = 0;
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
  // Sum of area times normal, and of that times the corner's place: three times the volume that a
  // closed surface holds, if it faces outward.
  Vec3 area_vector_m2;
  double three_volumes_m3 = 0;
};

// One value for all that a file shows, weighed by area.
struct Paint {
  Rgb reflectance{1, 1, 1}, luminance_nit;
  double tolerance = 1e-6;
};

struct Expected {
  std::string reason;             // why it is refused; empty: it is not
  std::map<int, Shape> of_nodes;  // by node
  Paint paint;
  PatchOptions options;
  double tolerance = 1e-6;  // of the shapes, relative
};

// The square that most of the files show: 1 m, in the plane z = 0, facing +z.
Shape Square() { return {2, 1, {-.5, -.5, 0}, {.5, .5, 0}, {0, 0, 1}, 0}; }
Expected SquareOf(const Paint& paint = {}) { return {"", {{0, Square()}}, paint, {}}; }

Expected BufferInterleaved(int) {
  // A picture times vertex colours, whatever the types of both and of the texture coordinates.
  return SquareOf({{.272862, .181908, .181908}, {}, 1e-6});
}

Expected Compatibility(int number) {
  // 1 to 3: of glTF 2.1, with properties that 2.0 does not know. 4: for readers of 2.1 alone. 5
  // requires an extension that nobody has.
  if (number == 4) return {"SCENE_INVALID", {}, {}, {}};
  if (number == 5) return {"EXTENSION_UNSUPPORTED", {}, {}, {}};
  return SquareOf();
}

Expected Material(int number) {
  Paint paint{{.2, .2, .2}, {}};  // normal and occlusion textures change nothing
  if (number == 3) paint.luminance_nit = {1, 1, 1};
  if (number == 6) paint.luminance_nit = {.0253773, .0187541, .0028635};
  if (number == 7) paint.luminance_nit = {.0225631, .0174565, .0028504};
  if (number >= 6) paint.tolerance = 1e-5;
  return SquareOf(paint);
}

Expected MaterialAlphaMask(int number) {
  // Texels with alpha, times that of the factor, from the cutoff on; and their mean colour.
  struct Kept {
    double area_m2;
    Rgb mean;
  };
  const Kept kept[] = {{.97253, {.41572, .22279, .15237}}, {.97345, {.41589, .22269, .15233}},
                       {.94684, {.41800, .22449, .15243}}, {0, {}},
                       {1, {.40908, .21790, .14917}},      {.97192, {.41563, .22285, .15239}},
                       {.55457, {.34551, .21087, .20571}}};
  const auto [area_m2, mean] = kept[number];
  if (area_m2 == 0) return {"NO_TRIANGLES", {}, {}, {}};
  Shape shape = Square();
  shape.patches = 0;
  shape.area_m2 = shape.area_vector_m2.z = area_m2;
  Expected expected{"", {{0, shape}}, {mean, {}, .002}, {}, .002};
  expected.options.max_edge_m = 1. / 64;  // two texels
  return expected;
}

Expected MaterialDoubleSided(int) {
  Expected expected = SquareOf();
  Shape& shape = expected.of_nodes[0];
  shape.patches = 4;
  shape.area_m2 = 2;
  shape.area_vector_m2 = {};
  return expected;
}

Expected MeshPrimitiveAttribute(int) { return SquareOf(); }

Expected MeshPrimitiveMode(int number) {
  // Points, lines, loops, strips of lines; strips and fans of triangles, and triangles: first
  // without, then with indices, of three types in the end.
  if (number % 7 < 4 && number < 11) return {"NO_TRIANGLES", {}, {}, {}};
  return SquareOf();
}

Expected MeshPrimitiveVertexColor(int) {
  // Green, red, yellow, blue round the square, the diagonal from red to blue: triangles of red,
  // green, blue and of red, blue, yellow. Alpha counts for nothing.
  return SquareOf({{1. / 2, 1. / 3, 1. / 3}, {}});
}

Expected MeshPrimitives(int) { return SquareOf({{0, 1. / 2, 1. / 2}, {}}); }

// Two nodes: a flat part that faces up, and under it a closed solid that faces outward.
struct Placed {
  bool half_turn = false;  // about y
  Vec3 scale{1, 1, 1};     // of one size
  Vec3 shift;
};
Expected FlatAndSolid(const Placed& placed) {
  const Shape flat{6, 114.75, {-7.5, -1, -7.5}, {7.5, -1, 7.5}, {0, 114.75, 0}, -114.75};
  Shape solid{48, 300, {-7.5, -2.5, -7.5}, {2.5, 7.5, 2.5}, {}, 656.25};
  const double size = std::abs(placed.scale.x);
  solid.area_m2 *= size * size;
  // Neither less nor negative when it is mirrored: the winding turns with it.
  solid.three_volumes_m3 *= size * size * size;
  const auto at = [&](Vec3 p) {
    if (placed.half_turn) p = {-p.x, p.y, -p.z};
    const Vec3 s = placed.scale;
    return Vec3{p.x * s.x, p.y * s.y, p.z * s.z} + placed.shift;
  };
  const Vec3 a = at(solid.low), b = at(solid.high);
  solid.low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  solid.high = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  return {"", {{0, flat}, {1, solid}}, {}, {}};
}

Expected NodeAttribute(int number) {
  const Vec3 shift{-2, 2, -2}, scale{1.2, 1.2, 1.2}, whole{1, 1, 1};
  const Placed placed[] = {{},
                           {false, whole, shift},
                           {false, whole, {shift.x, 0, 0}},
                           {false, whole, {0, shift.y, 0}},
                           {false, whole, {0, 0, shift.z}},
                           {true, whole, {}},
                           {false, scale, {}},
                           {true, scale, shift},
                           {true, scale, shift}};  // the last as a matrix
  return FlatAndSolid(placed[number]);
}

Expected NodeNegativeScale(int number) {
  // None, then x, x and y, all three: as a matrix, as a scale, with normals, with tangents.
  const Vec3 scales[] = {{-1, 1, 1}, {-1, -1, 1}, {-1, -1, -1}};
  return FlatAndSolid({false, number == 0 ? Vec3{1, 1, 1} : scales[(number - 1) % 3], {0, 2, 0}});
}

// By group: how many files, and what is expected of each.
struct Group {
  int files;
  Expected (*expect)(int number);
};
const std::map<std::string, Group> kGroups = {
    {"Buffer_Interleaved", {5, BufferInterleaved}},
    {"Compatibility", {6, Compatibility}},
    {"Material", {8, Material}},
    {"Material_AlphaMask", {7, MaterialAlphaMask}},
    {"Material_DoubleSided", {4, MaterialDoubleSided}},
    {"Mesh_PrimitiveAttribute", {7, MeshPrimitiveAttribute}},
    {"Mesh_PrimitiveMode", {16, MeshPrimitiveMode}},
    {"Mesh_PrimitiveVertexColor", {6, MeshPrimitiveVertexColor}},
    {"Mesh_Primitives", {1, MeshPrimitives}},
    {"Node_Attribute", {9, NodeAttribute}},
    {"Node_NegativeScale", {13, NodeNegativeScale}},
};

absl::StatusOr<PatchSet> Load(const std::filesystem::path& path, const PatchOptions& options) {
  absl::StatusOr<Scene> scene = LoadGltf(ReadBundle(path));
  if (!scene.ok()) return scene.status();
  return BuildPatches(*scene, options);
}

std::map<int, Shape> ShapesOf(const PatchSet& patches) {
  std::map<int, Shape> shapes;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    Shape& shape = shapes[patches.source[i].node];
    const Vec3 area_vector_m2 = patches.area_m2[i] * PatchNormal(patches, i);
    ++shape.patches;
    shape.area_m2 += patches.area_m2[i];
    shape.area_vector_m2 = shape.area_vector_m2 + area_vector_m2;
    for (const Vec3& corner : patches.corners[i]) {
      Bounds box{shape.low, shape.high};
      box.Add(patches.origin + corner);
      shape.low = box.low;
      shape.high = box.high;
    }
    shape.three_volumes_m3 += Dot(area_vector_m2, patches.origin + patches.corners[i][0]);
  }
  return shapes;
}

void ExpectNear(Vec3 a, Vec3 b, double tolerance) { EXPECT_LT(Length(a - b), tolerance); }
void ExpectNear(Rgb a, Rgb b, double tolerance) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

void ExpectShape(const Shape& shape, const Shape& expected, double tolerance) {
  const double size_m = Length(expected.high - expected.low);
  if (expected.patches > 0) {
    EXPECT_EQ(shape.patches, expected.patches);
    ExpectNear(shape.low, expected.low, 1e-6 * size_m);
    ExpectNear(shape.high, expected.high, 1e-6 * size_m);
  }
  EXPECT_NEAR(shape.area_m2, expected.area_m2, tolerance * expected.area_m2);
  ExpectNear(shape.area_vector_m2, expected.area_vector_m2, tolerance * expected.area_m2);
  EXPECT_NEAR(shape.three_volumes_m3, expected.three_volumes_m3,
              tolerance * expected.area_m2 * size_m);
}

void ExpectPatches(const PatchSet& patches, const Expected& expected) {
  const std::map<int, Shape> shapes = ShapesOf(patches);
  ASSERT_EQ(shapes.size(), expected.of_nodes.size());
  for (const auto& [node, shape] : expected.of_nodes) {
    SCOPED_TRACE("node " + std::to_string(node));
    ASSERT_TRUE(shapes.contains(node));
    ExpectShape(shapes.at(node), shape, expected.tolerance);
  }
  Rgb reflectance, exitance;
  double area_m2 = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    area_m2 += patches.area_m2[i];
    reflectance = reflectance + patches.reflectance[i] * patches.area_m2[i];
    exitance = exitance + patches.exitance_lm_per_m2[i] * patches.area_m2[i];
  }
  ExpectNear(reflectance / area_m2, expected.paint.reflectance, expected.paint.tolerance);
  ExpectNear(exitance / area_m2, expected.paint.luminance_nit * std::numbers::pi,
             expected.paint.tolerance * std::numbers::pi);
}

TEST(Conformance, EachFileOfTheAssetGeneratorHasTheNumbersThatItsGroupIsAbout) {
  const std::vector<std::filesystem::path> paths = ScenesIn("conformance");
  if (paths.empty()) GTEST_SKIP() << "no conformance scenes";
  std::map<std::string, int> files;
  for (const std::filesystem::path& path : paths) {
    SCOPED_TRACE(path.filename());
    const std::string stem = path.stem(), name = stem.substr(0, stem.rfind('_'));
    ASSERT_TRUE(kGroups.contains(name));
    const Expected expected = kGroups.at(name).expect(std::stoi(stem.substr(name.size() + 1)));
    ++files[name];
    const absl::StatusOr<PatchSet> patches = Load(path, expected.options);
    if (!expected.reason.empty()) {
      EXPECT_EQ(ReasonOf(patches.status()), expected.reason) << patches.status();
      continue;
    }
    ASSERT_TRUE(patches.ok()) << patches.status();
    ExpectPatches(*patches, expected);
  }
  for (const auto& [name, group] : kGroups) EXPECT_EQ(files[name], group.files) << name;
}

}  // namespace
}  // namespace lambert
