#include "radiosity/patch/texture_mean.h"

#include <gtest/gtest.h>

#include "radiosity/patch/patch_material.h"

namespace lambert {
namespace {

constexpr std::array<Uv, 3> kLowerHalf = {Uv{0, 0}, Uv{1, 0}, Uv{1, 1}};

Texture Uniform(int width, int height, uint8_t code) {
  return {width, height, std::vector<uint8_t>(size_t{4} * width * height, code)};
}

// Black and white fields of one texel.
Texture Checker(int size) {
  Texture texture = Uniform(size, size, 0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int k = 0; k < 3; ++k) texture.rgba[4 * (y * size + x) + k] = (x + y) % 2 ? 255 : 0;
    }
  }
  return texture;
}

TEST(SrgbToLinear, HitsTheStandardsValues) {
  EXPECT_EQ(SrgbToLinear(0), 0);
  EXPECT_EQ(SrgbToLinear(255), 1);
  EXPECT_NEAR(SrgbToLinear(188), 0.502886, 1e-6);
  EXPECT_NEAR(SrgbToLinear(10), 10 / 255.0 / 12.92, 1e-15);
}

TEST(TextureMean, IsExactForOneTexelAndForAUniformTexture) {
  EXPECT_EQ(TextureMean(Uniform(1, 1, 188), kLowerHalf, 512).r, SrgbToLinear(188));
  EXPECT_NEAR(TextureMean(Uniform(64, 32, 188), kLowerHalf, 512).g, SrgbToLinear(188),
              512 * 512 * 2.3e-16);  // one rounding a sample
}

TEST(TextureMean, OfTheTwoHalvesOfACheckerIsOneHalf) {
  const Texture checker = Checker(16);
  const Rgb lower = TextureMean(checker, kLowerHalf, 512);
  const Rgb upper = TextureMean(checker, {Uv{0, 0}, Uv{1, 1}, Uv{0, 1}}, 512);
  EXPECT_NEAR((lower.r + upper.r) / 2, 0.5, 1e-3);
}

TEST(TextureMean, DecodesBeforeItAverages) {
  Texture texture = Uniform(2, 1, 0);
  texture.rgba = {0, 0, 0, 255, 188, 188, 188, 255};
  const Rgb a = TextureMean(texture, {Uv{0, 0}, Uv{1, 0}, Uv{1, 1}}, 512);
  const Rgb b = TextureMean(texture, {Uv{0, 0}, Uv{1, 1}, Uv{0, 1}}, 512);
  EXPECT_NEAR((a.r + b.r) / 2, SrgbToLinear(188) / 2, 5e-3);
}

TEST(TextureMean, WrapModesDecideOutsideTheUnitSquare) {
  Texture texture = Uniform(2, 1, 0);
  texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255};  // black, white
  const std::array<Uv, 3> beyond = {Uv{1.1, 0.5}, Uv{1.4, 0.5}, Uv{1.2, 0.6}};
  EXPECT_EQ(TextureMean(texture, beyond, 64).r, 0);
  texture.wrap_u = Texture::Wrap::kMirroredRepeat;
  EXPECT_EQ(TextureMean(texture, beyond, 64).r, 1);
  texture.wrap_u = Texture::Wrap::kClampToEdge;
  EXPECT_EQ(TextureMean(texture, beyond, 64).r, 1);
  texture.wrap_u = Texture::Wrap::kRepeat;
  EXPECT_EQ(TextureMean(texture, {Uv{-0.9, 0}, Uv{-0.6, 0}, Uv{-0.8, 0.1}}, 64).r, 0);
}

// A green texel of alpha 127 and a red one of 128.
Texture HalfCut() { return {2, 1, {0, 255, 0, 127, 255, 0, 0, 128}}; }
constexpr std::array<Uv, 3> kUpperHalf = {Uv{0, 0}, Uv{1, 1}, Uv{0, 1}};

TEST(TextureMean, OfTexelsThatAreNotCutLeavesOutTheOthers) {
  EXPECT_EQ(TextureMean(HalfCut(), kLowerHalf, 512, 128), (Rgb{1, 0, 0}));
  EXPECT_EQ(TextureMean(HalfCut(), kLowerHalf, 512, 129), (Rgb{}));
  EXPECT_EQ(TextureMean(HalfCut(), kLowerHalf, 512, 127), TextureMean(HalfCut(), kLowerHalf, 512));
}

TEST(TextureCoverage, IsTheShareOfTexelsOfThatAlphaOrMore) {
  for (const auto& [least_alpha, both] : {std::pair{127, 2.0}, {128, 1.0}, {129, 0.0}}) {
    EXPECT_NEAR(TextureCoverage(HalfCut(), kLowerHalf, 512, least_alpha) +
                    TextureCoverage(HalfCut(), kUpperHalf, 512, least_alpha),
                both, 5e-3);
  }
  // Of the right one of the two triangles three quarters lie in the right one of the texels.
  EXPECT_NEAR(TextureCoverage(HalfCut(), kLowerHalf, 512, 128), 0.75, 5e-3);
}

TEST(TextureMean, HugeCoordinatesStayBoundedInTimeAndRange) {
  const Rgb mean = TextureMean(Checker(16), {Uv{0, 0}, Uv{1e30, 0}, Uv{0, -1e30}}, 64);
  EXPECT_GE(mean.r, 0);
  EXPECT_LE(mean.r, 1);
}

TEST(MakePatchMaterials, LeavesOutTexturesThatNoFactorShows) {
  Scene scene;
  scene.textures.push_back(Uniform(1, 1, 0));
  scene.materials.resize(1);
  scene.materials[0].reflectance = {0, 0, 0};
  scene.materials[0].reflectance_texture = 0;
  scene.materials[0].luminance_texture = 0;
  std::vector<Warning> warnings;
  const auto materials = MakePatchMaterials(scene, false, &warnings);
  ASSERT_TRUE(materials.ok());
  EXPECT_EQ((*materials)[1].reflectance_texture, nullptr);
  EXPECT_EQ((*materials)[1].exitance_texture, nullptr);
  EXPECT_EQ((*materials)[0].reflectance, (Rgb{1, 1, 1}));
}

TEST(MakePatchMaterials, CutTexelsUnderTheCutoffAlsoOfBlackTextures) {
  struct Case {
    double cutoff, alpha;
    int least_alpha;
  };
  for (const Case& c : {Case{0, 1, 0}, Case{0, 0, 0}, Case{0.5, 1, 128}, Case{128 / 255.0, 1, 128},
                        Case{0.501960814, 1, 128}, Case{0.6, 0.7, 219}, Case{1, 1, 255},
                        Case{1.1, 1, 256}, Case{0.5, 0, 256}}) {
    Scene scene;
    scene.textures.push_back(Uniform(1, 1, 0));
    scene.materials.resize(1);
    scene.materials[0].reflectance = {0, 0, 0};
    scene.materials[0].reflectance_texture = 0;
    scene.materials[0].alpha_cutoff = c.cutoff;
    scene.materials[0].alpha = c.alpha;
    std::vector<Warning> warnings;
    const PatchMaterial made = (*MakePatchMaterials(scene, false, &warnings))[1];
    EXPECT_EQ(made.least_alpha, c.least_alpha) << c.cutoff << " " << c.alpha;
    EXPECT_EQ(made.alpha_texture, c.least_alpha > 0 ? &scene.textures[0] : nullptr);
    EXPECT_EQ(made.reflectance_texture, nullptr);
  }
}

}  // namespace
}  // namespace lambert
