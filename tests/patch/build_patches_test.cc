#include "radiosity/patch/build_patches.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <numeric>

#include "radiosity/core/error.h"
#include "radiosity/patch/morton.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

double TotalArea(const PatchSet& patches) {
  return std::accumulate(patches.area_m2.begin(), patches.area_m2.end(), 0.0);
}

bool HasWarning(const PatchSet& patches, const std::string& reason) {
  for (const Warning& warning : patches.warnings) {
    if (warning.reason == reason) return true;
  }
  return false;
}

// One triangle per call: a scene of loose triangles in one primitive.
Scene Triangles(const std::vector<std::array<Vec3, 3>>& triangles) {
  Scene scene = MakeFurnace(0.5);
  Primitive& primitive = scene.meshes[0].primitives[0];
  scene.meshes[0].primitives.resize(1);
  primitive.positions.clear();
  primitive.triangles.clear();
  for (const auto& corners : triangles) {
    const uint32_t first = static_cast<uint32_t>(primitive.positions.size());
    for (Vec3 p : corners) primitive.positions.push_back({float(p.x), float(p.y), float(p.z)});
    primitive.triangles.push_back({first, first + 1, first + 2});
  }
  return scene;
}

void ExpectFacesInward(const PatchSet& patches) {
  Vec3 center;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    center = center + PatchCentroid(patches, i) / patches.size();
  }
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_GT(Dot(PatchNormal(patches, i), center - PatchCentroid(patches, i)), 0) << i;
  }
}

TEST(BuildPatches, UnitCubeHasAreaSixAndExitancePiTimesLuminance) {
  Scene scene = MakeFurnace(0.5);
  scene.materials[0].luminance = {1, 2, 3};
  const PatchSet patches = PatchesOf(scene);
  ASSERT_EQ(patches.size(), 12);
  EXPECT_DOUBLE_EQ(TotalArea(patches), 6);
  EXPECT_EQ(patches.origin, (Vec3{0.5, 0.5, 0.5}));
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_EQ(patches.exitance_lm_per_m2[i], (Rgb{1, 2, 3} * std::numbers::pi));
    EXPECT_EQ(patches.twin[i], kNoPatch);
  }
  EXPECT_NEAR(EmittedFlux(patches).g, 12 * std::numbers::pi, 1e-12);
  ExpectFacesInward(patches);
}

TEST(BuildPatches, NegativeDeterminantFlipsTheWindingOnce) {
  Scene scene = MakeFurnace(0.5);
  scene.instances[0].world.x = {-1, 0, 0};
  ExpectFacesInward(PatchesOf(scene));
  scene.instances[0].world.y = {0, -1, 0};
  ExpectFacesInward(PatchesOf(scene));
}

TEST(BuildPatches, AreasAreMeasuredAfterTheTransform) {
  Scene scene = MakeFurnace(0.5);
  scene.instances[0].world = {{1e-3, 0, 0}, {0, 1, 0}, {0, 0, 1e3}, {5, 6, 7}};
  EXPECT_NEAR(TotalArea(PatchesOf(scene)), 2 * (1e-3 + 1e3 + 1), 1e-9);
}

TEST(BuildPatches, ShapeIsTheSameAtEveryScale) {
  for (double scale : {1e-20, 1e-6, 1e6, 1e15}) {
    Scene scene = MakeFurnace(0.5);
    scene.instances[0].world = {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, {}};
    const PatchSet patches = PatchesOf(scene);
    ASSERT_EQ(patches.size(), 12) << scale;
    EXPECT_NEAR(TotalArea(patches) / scale / scale, 6, 1e-12) << scale;
    ExpectFacesInward(patches);
  }
}

TEST(BuildPatches, SmallCubeFarAwayKeepsItsDigits) {
  Scene scene = MakeFurnace(0.5);
  scene.instances[0].world = {{0.125, 0, 0}, {0, 0.125, 0}, {0, 0, 0.125}, {1e8, -1e8, 1e8}};
  const PatchSet patches = PatchesOf(scene);
  EXPECT_NEAR(TotalArea(patches), 6 * 0.125 * 0.125, 1e-15);
  EXPECT_EQ(patches.origin, (Vec3{1e8 + 0.0625, -1e8 + 0.0625, 1e8 + 0.0625}));
}

TEST(BuildPatches, TrianglesWithoutAreaAreDroppedAndCounted) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const PatchSet patches = PatchesOf(Triangles({{a, b, c}, {a, a, a}, {a, b, b}, {a, b, b * 3}}));
  EXPECT_EQ(patches.size(), 1);
  EXPECT_TRUE(HasWarning(patches, "ZERO_AREA_PATCHES"));
}

TEST(BuildPatches, RotatedLinesAreDroppedAndSliversOfOneInAMillionStay) {
  const Vec3 line{0.3, 0.7, 0.9};
  Scene scene = Triangles({{Vec3{}, line, line * 2.0},
                           {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1e-6, 0}},
                           {Vec3{0, 0, 2}, Vec3{1, 0, 2}, Vec3{0, 0x1p-40, 2}}});
  scene.instances[0].world = {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}, {0.1, 0.2, 0.3}};
  EXPECT_EQ(PatchesOf(scene).size(), 2);
}

TEST(BuildPatches, ExactCopiesAreDroppedAndBacksOfThemStay) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{1, 1, 0};
  const PatchSet patches = PatchesOf(Triangles({{a, b, c}, {b, c, a}, {b, d, c}, {a, c, b}}));
  EXPECT_EQ(patches.size(), 3);
  EXPECT_TRUE(HasWarning(patches, "DUPLICATE_PATCHES"));
  std::vector<int> kept;
  for (const PatchSource& source : patches.source) kept.push_back(source.triangle);
  std::sort(kept.begin(), kept.end());
  EXPECT_EQ(kept, (std::vector<int>{0, 2, 3}));
}

TEST(BuildPatches, TwoSidedTrianglesAreFrontThenBack) {
  Scene scene = MakeFurnace(0.5);
  scene.materials[0].two_sided = true;
  const PatchSet patches = PatchesOf(scene);
  ASSERT_EQ(patches.size(), 24);
  for (PatchIndex i = 0; i < 24; i += 2) {
    EXPECT_EQ(patches.twin[i], i + 1);
    EXPECT_EQ(patches.twin[i + 1], i);
    EXPECT_EQ(patches.is_back[i], 0);
    EXPECT_EQ(patches.is_back[i + 1], 1);
    EXPECT_EQ(patches.source[i], patches.source[i + 1]);
    EXPECT_NEAR(Dot(PatchNormal(patches, i), PatchNormal(patches, i + 1)), -1, 1e-15);
  }
  PatchOptions options;
  options.two_sided = true;
  EXPECT_EQ(BuildPatches(MakeFurnace(0.5), options)->size(), 24);
}

TEST(BuildPatches, OrderIsMortonOfCentroidsAndEqualScenesGiveEqualBytes) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  std::vector<Vec3> centroids;
  for (PatchIndex i = 0; i < patches.size(); ++i) centroids.push_back(PatchCentroid(patches, i));
  const std::vector<uint64_t> codes = MortonCodes(centroids);
  EXPECT_TRUE(std::is_sorted(codes.begin(), codes.end()));
  EXPECT_EQ(EncodePatchSet(patches), EncodePatchSet(PatchesOf(MakeOffice(2))));
}

TEST(BuildPatches, SplittingKeepsAreaAndBoundsEdges) {
  PatchOptions options;
  options.max_edge_m = 0.3;
  const absl::StatusOr<PatchSet> patches = BuildPatches(MakeCornell(), options);
  ASSERT_TRUE(patches.ok());
  EXPECT_NEAR(TotalArea(*patches), TotalArea(PatchesOf(MakeCornell())), 1e-9);
  for (const auto& [a, b, c] : patches->corners) {
    EXPECT_LE(std::max({Length(b - a), Length(c - b), Length(a - c)}), 0.3);
  }
}

TEST(BuildPatches, TooManyPatchesAreRefusedBeforeTheyAreMade) {
  PatchOptions options;
  options.max_edge_m = 1e-300;
  EXPECT_EQ(ReasonOf(BuildPatches(MakeCornell(), options).status()), "SCENE_TOO_LARGE");
  options = {};
  options.max_patches = 11;
  EXPECT_EQ(ReasonOf(BuildPatches(MakeFurnace(0.5), options).status()), "SCENE_TOO_LARGE");
  options.max_patches = 12;
  EXPECT_TRUE(BuildPatches(MakeFurnace(0.5), options).ok());
}

TEST(BuildPatches, ReflectanceOverOneIsClampedAndHighReflectanceIsNamed) {
  Scene scene = MakeFurnace(0.5);
  EXPECT_FALSE(HasWarning(PatchesOf(scene), "REFLECTANCE_HIGH"));
  scene.materials[0].reflectance = {0.96, 0.5, 0.5};
  EXPECT_TRUE(HasWarning(PatchesOf(scene), "REFLECTANCE_HIGH"));
  EXPECT_FALSE(HasWarning(PatchesOf(scene), "REFLECTANCE_CLAMPED"));
  scene.materials[0].reflectance = {1.5, 0.5, 0.5};
  EXPECT_TRUE(HasWarning(PatchesOf(scene), "REFLECTANCE_CLAMPED"));
  EXPECT_EQ(PatchesOf(scene).reflectance[0], (Rgb{1, 0.5, 0.5}));
}

TEST(BuildPatches, ValuesThatAreNotFiniteAreRefusedByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Scene scene = MakeFurnace(0.5);
  scene.materials[0].reflectance.g = kNan;
  EXPECT_NE(BuildPatches(scene, {}).status().message().find("material 0"), std::string::npos);
  scene = MakeFurnace(0.5);
  scene.materials[0].luminance.b = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ReasonOf(BuildPatches(scene, {}).status()), "SCENE_INVALID");
  scene = MakeFurnace(0.5);
  scene.instances[0].world.translation.x = kNan;
  EXPECT_NE(BuildPatches(scene, {}).status().message().find("node 0"), std::string::npos);
  scene = MakeFurnace(0.5);
  scene.lights.push_back({"bad", {}, {kNan, 0, 0}});
  EXPECT_EQ(ReasonOf(BuildPatches(scene, {}).status()), "SCENE_INVALID");
}

TEST(BuildPatches, NothingToShowIsAnErrorAndNothingThatEmitsIsAWarning) {
  EXPECT_EQ(ReasonOf(BuildPatches(Scene(), {}).status()), "NO_TRIANGLES");
  EXPECT_EQ(ReasonOf(BuildPatches(Triangles({{Vec3{}, Vec3{}, Vec3{}}}), {}).status()),
            "NO_TRIANGLES");
  EXPECT_TRUE(HasWarning(PatchesOf(MakeFurnace(0.5, 0)), "NO_EMITTERS"));
  EXPECT_FALSE(HasWarning(PatchesOf(MakeFurnace(0.5, 1)), "NO_EMITTERS"));
}

TEST(BuildPatches, OnlyAClosedSceneFacingOutwardIsSaidToBeInsideOut) {
  const std::vector<Paint> paint = {{{0.5, 0.5, 0.5}, {1, 1, 1}}};
  const Scene outward = SceneMaker().Box({}, {1, 1, 1}, false, paint).Make();
  EXPECT_TRUE(HasWarning(PatchesOf(outward), "POSSIBLY_INVERTED_NORMALS"));
  for (const Scene& scene :
       {MakeFurnace(0.5), MakeOffice(1), MakeCornell(), MakeParallelSquares(0.5, 0.5)}) {
    EXPECT_FALSE(HasWarning(PatchesOf(scene), "POSSIBLY_INVERTED_NORMALS"));
  }
}

TEST(BuildPatches, LightsAndCamerasMoveWithTheOrigin) {
  const Scene scene = SceneMaker()
                          .Box({10, 10, 10}, {12, 12, 12}, true, {{{0.5, 0.5, 0.5}, {}}})
                          .Light({11, 11.5, 11}, {100, 100, 100})
                          .LookFrom({11, 11, 11.75}, {11, 11, 11})
                          .Make();
  const PatchSet patches = PatchesOf(scene);
  EXPECT_EQ(patches.lights[0].position, (Vec3{0, 0.5, 0}));
  EXPECT_EQ(patches.cameras[0].world.translation, (Vec3{0, 0, 0.75}));
  EXPECT_NEAR(EmittedFlux(patches).r, 400 * std::numbers::pi, 1e-9);
}

TEST(BuildPatches, PointLightsOnAPatchAreNamedAndOnesNearByAreNot) {
  const auto warns = [](Vec3 position) {
    const Scene scene = SceneMaker()
                            .Quad({}, {0, 0, 1}, {1, 0, 0}, {{0.5, 0.5, 0.5}, {}})
                            .Light({0.5, 0.5, 0.5}, {1, 1, 1})
                            .Light(position, {1, 1, 1})
                            .Make();
    return HasWarning(PatchesOf(scene), "LIGHT_ON_SURFACE");
  };
  for (Vec3 on : {Vec3{0.25, 0, 0.5}, Vec3{0.25, 1e-6, 0.5}, Vec3{0.25, -1e-6, 0.5}, Vec3{1, 0, 1},
                  Vec3{1 + 1e-6, 0, 0.5}}) {
    EXPECT_TRUE(warns(on)) << on.x << " " << on.y;
  }
  for (Vec3 off : {Vec3{0.25, 2e-6, 0.5}, Vec3{1 + 2e-6, 0, 0.5}, Vec3{3, 0, 0.5}}) {
    EXPECT_FALSE(warns(off)) << off.x << " " << off.y;
  }
}

TEST(BuildPatches, TextureWithoutCoordinatesIsRefused) {
  Scene scene = MakeFurnace(0.5);
  scene.textures.push_back({1, 1, {188, 188, 188, 255}});
  scene.materials[0].reflectance_texture.texture = 0;
  EXPECT_NE(BuildPatches(scene, {}).status().message().find("TEXCOORD_0"), std::string::npos);
}

// Two triangles of a unit square, whose texture is two texels wide: green of alpha 0, red of 255.
Scene MaskedSquare(double cutoff) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {1, 1, 1}}).Make();
  for (const auto& p : scene.meshes[0].primitives[0].positions) {
    scene.meshes[0].primitives[0].uv[0].push_back({p[0], p[1]});
  }
  scene.textures.push_back({2, 1, {0, 255, 0, 0, 255, 0, 0, 255}});
  scene.materials[0].reflectance_texture.texture = 0;
  scene.materials[0].alpha_cutoff = cutoff;
  return scene;
}

TEST(BuildPatches, MaskLeavesOutThePatchesThatItCutsByMoreThanHalf) {
  EXPECT_EQ(PatchesOf(MaskedSquare(0)).size(), 2);
  const PatchSet patches = PatchesOf(MaskedSquare(0.5));
  ASSERT_EQ(patches.size(), 1);
  EXPECT_GT(PatchCentroid(patches, 0).x, 0) << "the triangle with more of the red texel";
  EXPECT_EQ(patches.reflectance[0], (Rgb{0.5, 0, 0}));
  EXPECT_TRUE(HasWarning(patches, "PARTLY_CUT_PATCHES"));
}

TEST(BuildPatches, MaskLeavesTheOpaqueHalfOfASquareThatIsSplit) {
  PatchOptions options;
  options.max_edge_m = 0.1;
  const absl::StatusOr<PatchSet> patches = BuildPatches(MaskedSquare(0.5), options);
  ASSERT_TRUE(patches.ok());
  EXPECT_NEAR(TotalArea(*patches), 0.5, 1e-12);
  EXPECT_FALSE(HasWarning(*patches, "PARTLY_CUT_PATCHES"));
}

TEST(BuildPatches, TexturesAreMetWhereTheirTransformPutsThem) {
  Scene scene = MaskedSquare(0);
  TextureUse& use = scene.materials[0].reflectance_texture;
  const auto reflectance = [&scene] { return PatchesOf(scene).reflectance[0]; };
  use.row_u = {0.5, 0, 0};  // the green texel on the left
  EXPECT_EQ(reflectance(), (Rgb{0, 0.5, 0}));
  use.row_u = {0.5, 0, 0.5};
  EXPECT_EQ(reflectance(), (Rgb{0.5, 0, 0}));
  scene.meshes[0].primitives[0].uv[3] = scene.meshes[0].primitives[0].uv[0];
  for (auto& uv : scene.meshes[0].primitives[0].uv[3]) uv = {0.1f, 0};
  use = {.texture = 0, .uv_set = 3};
  EXPECT_EQ(reflectance(), (Rgb{0, 0.5, 0}));
}

TEST(BuildPatches, VertexColoursMultiplyTheReflectanceAndSplitWithTheTriangle) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {1, 1, 1}}).Make();
  for (const auto& p : scene.meshes[0].primitives[0].positions) {
    scene.meshes[0].primitives[0].colors.push_back({p[0], p[1], 1, 1});
  }
  PatchOptions options;
  options.max_edge_m = 0.3;
  const absl::StatusOr<PatchSet> patches = BuildPatches(scene, options);
  ASSERT_TRUE(patches.ok()) << patches.status();
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    const Vec3 centre = PatchCentroid(*patches, i) + patches->origin;
    EXPECT_NEAR(patches->reflectance[i].r, centre.x / 2, 1e-7);
    EXPECT_NEAR(patches->reflectance[i].g, centre.y / 2, 1e-7);
    EXPECT_EQ(patches->reflectance[i].b, 0.5);
    EXPECT_EQ(patches->exitance_lm_per_m2[i].r, PatchesOf(scene).exitance_lm_per_m2[0].r);
  }
}

TEST(BuildPatches, AMaskThatCutsEverythingIsSaidToBeTheReason) {
  Scene scene = MaskedSquare(0.5);
  scene.materials[0].alpha = 0.49;
  const absl::Status status = BuildPatches(scene, {}).status();
  EXPECT_EQ(ReasonOf(status), "NO_TRIANGLES");
  EXPECT_NE(status.message().find("MASK"), std::string::npos) << status;
  scene.materials[0].reflectance_texture.texture = -1;
  EXPECT_EQ(ReasonOf(BuildPatches(scene, {}).status()), "NO_TRIANGLES");
  scene.materials[0].alpha = 0.5;
  EXPECT_EQ(PatchesOf(scene).size(), 2);
}

TEST(PatchOptions, ValidateNamesTheFieldThatIsOutOfRange) {
  PatchOptions options;
  EXPECT_TRUE(options.Validate().ok());
  options.max_edge_m = -1;
  EXPECT_NE(options.Validate().message().find("max_edge_m"), std::string::npos);
  options = {};
  options.max_patches = 0;
  EXPECT_EQ(ReasonOf(options.Validate()), "FIELD_INVALID");
}

}  // namespace
}  // namespace lambert
