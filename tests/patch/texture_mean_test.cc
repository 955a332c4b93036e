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

Rgb TextureMean(const Texture& texture, const std::array<Uv, 3>& uv, int samples) {
  return MeanOver({.texture = &texture, .uv = uv}, samples).mean;
}

// Where texels of `least_alpha` or more are surface.
MaskedMean Masked(const Texture& texture, const std::array<Uv, 3>& uv, int least_alpha) {
  return MeanOver({.texture = &texture, .uv = uv}, 512, 1, least_alpha / 255.0);
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
  EXPECT_EQ(Masked(HalfCut(), kLowerHalf, 128).mean, (Rgb{1, 0, 0}));
  EXPECT_EQ(Masked(HalfCut(), kLowerHalf, 129).mean, (Rgb{}));
  EXPECT_EQ(Masked(HalfCut(), kLowerHalf, 127).mean, TextureMean(HalfCut(), kLowerHalf, 512));
}

TEST(TextureMean, CoverageIsTheShareOfTexelsOfThatAlphaOrMore) {
  for (const auto& [least_alpha, both] : {std::pair{127, 2.0}, {128, 1.0}, {129, 0.0}}) {
    EXPECT_NEAR(Masked(HalfCut(), kLowerHalf, least_alpha).coverage +
                    Masked(HalfCut(), kUpperHalf, least_alpha).coverage,
                both, 5e-3);
  }
  // Of the right one of the two triangles three quarters lie in the right one of the texels.
  EXPECT_NEAR(Masked(HalfCut(), kLowerHalf, 128).coverage, 0.75, 5e-3);
}

TEST(TextureMean, ACutoffIsComparedAsAFloat) {
  struct Case {
    double cutoff, alpha;
    int least_alpha;  // 256: all is cut
  };
  for (const Case& c : {Case{0, 1, 0}, Case{0, 0, 0}, Case{0.5, 1, 128}, Case{128 / 255.0, 1, 128},
                        Case{0.501960814, 1, 128}, Case{0.6, 0.7, 219}, Case{1, 1, 255},
                        Case{1.1, 1, 256}, Case{0.5, 0, 256}}) {
    for (int code : {0, 127, 128, 218, 219, 254, 255}) {
      const Texture texture = Uniform(1, 1, static_cast<uint8_t>(code));
      EXPECT_EQ(MeanOver({.texture = &texture}, 512, c.alpha, c.cutoff).coverage,
                code >= c.least_alpha ? 1 : 0)
          << c.cutoff << " " << c.alpha << " " << code;
    }
  }
}

TEST(TextureMean, VertexColoursAreTheirMeanAndMultiplyTheTexture) {
  PaintedTriangle triangle{.colors = {{{1, 0, 0, 1}, {0, 1, 0, 1}, {0.5, 0.5, 1, 1}}}};
  const Rgb mean = MeanOver(triangle, 512).mean;
  EXPECT_NEAR(mean.r, 0.5, 1e-15);
  EXPECT_NEAR(mean.g, 0.5, 1e-15);
  EXPECT_NEAR(mean.b, 1 / 3.0, 1e-15);
  // Black left of the middle and white right of it; red grows from 0 on the left to 1 on the right.
  const Texture halves = {2, 1, {0, 0, 0, 255, 255, 255, 255, 255}};
  Rgb sum;
  for (const std::array<Uv, 3>& uv : {kLowerHalf, kUpperHalf}) {
    triangle = {.texture = &halves, .uv = uv};
    for (int k = 0; k < 3; ++k) triangle.colors[k] = {static_cast<float>(uv[k][0]), 1, 1, 1};
    sum = sum + MeanOver(triangle, 512).mean;
  }
  EXPECT_NEAR(sum.r / 2, 3 / 8.0, 2e-3) << "the integral of u over the right half";
  EXPECT_NEAR(sum.g / 2, 1 / 2.0, 2e-3);
}

TEST(TextureMean, AlphaOfVertexColoursCuts) {
  PaintedTriangle triangle{.colors = {{{1, 1, 1, 1}, {1, 1, 1, 0}, {1, 1, 1, 0}}}};
  // Alpha is over one half in the corner triangle of half the height: a quarter of the area.
  EXPECT_NEAR(MeanOver(triangle, 512, 1, 0.5).coverage, 0.25, 0.02);
  triangle.colors[0] = {1, 1, 1, 0};
  EXPECT_EQ(MeanOver(triangle, 512, 1, 0.5).coverage, 0);
  EXPECT_EQ(MeanOver(triangle, 512).coverage, 1) << "no mask";
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
  scene.materials[0].reflectance_texture.texture = 0;
  scene.materials[0].luminance_texture.texture = 0;
  std::vector<Warning> warnings;
  const auto materials = MakePatchMaterials(scene, {}, &warnings);
  ASSERT_TRUE(materials.ok());
  EXPECT_EQ((*materials)[1].reflectance_texture.texture, -1);
  EXPECT_EQ((*materials)[1].exitance_texture.texture, -1);
  EXPECT_EQ((*materials)[0].reflectance, (Rgb{1, 1, 1}));
  scene.materials[0].alpha_cutoff = 0.5;
  EXPECT_EQ((*MakePatchMaterials(scene, {}, &warnings))[1].reflectance_texture.texture, 0)
      << "its alpha shows";
}

}  // namespace
}  // namespace lambert
