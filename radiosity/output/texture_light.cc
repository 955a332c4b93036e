#include "radiosity/output/texture_light.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "radiosity/output/texture_image.h"

namespace lambert {
namespace {

// Each costs a copy of the texture: close where bright texels, which a gain too great would cut
// off, need them.
constexpr double kGains[] = {1, 1.4, 2, 4, 8, 16};
// Where the texture as it is shows nearly as much, it is taken: neighbours that differ show a step.
constexpr double kPlainShare = 1.15;

// Whether all that a material sends out is the same texture times something.
bool IsOneTexture(const Material& material, Rgb exitance_lm_per_m2) {
  const TextureUse &base = material.reflectance_texture, &light = material.luminance_texture;
  return base.texture >= 0 && (exitance_lm_per_m2 == Rgb{} ||
                               (base.texture == light.texture && base.uv_set == light.uv_set &&
                                base.row_u == light.row_u && base.row_v == light.row_v));
}

int WrapCode(Texture::Wrap wrap) {
  return wrap == Texture::Wrap::kRepeat        ? 10497
         : wrap == Texture::Wrap::kClampToEdge ? 33071
                                               : 33648;
}

}  // namespace

TextureLight::TextureLight(const PatchSet& patches,
                           const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                           const Exposure& exposure, const Scene* scene)
    : patches_(patches),
      corner_irradiance_lx_(corner_irradiance_lx),
      exposure_(exposure),
      scene_(scene),
      material_(patches.corners.size(), -1),
      gain_(patches.corners.size(), 1) {
  if (scene == nullptr || scene->textures.empty()) return;
  placed_ = PlaceScene(*scene, patches.origin);
  triangle_ = FindTriangles(*scene, placed_, patches);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PlacedSurface& surface = placed_.surfaces[placed_.SurfaceOf(triangle_[i])];
    const int material = PrimitiveOf(*scene, surface).material;
    if (material < 0) continue;
    if (!IsOneTexture(scene->materials[material], patches.exitance_lm_per_m2[i])) continue;
    material_[i] = material;
    gain_[i] = ChooseGain(i);
  }
}

// Neither the texture times the gain nor the color over it can pass 1: that which takes least off a
// patch of the mean texel.
double TextureLight::ChooseGain(PatchIndex i) const {
  const Material& material = scene_->materials[material_[i]];
  const Rgb factor = material.reflectance + material.luminance * std::numbers::pi;
  const Rgb mean = patches_.reflectance[i] + patches_.exitance_lm_per_m2[i];
  std::array<double, 3> wanted{};
  for (int corner = 0; corner < 3; ++corner) {
    const Rgb color = Ungained(i, corner).color;
    wanted[corner] = std::max({color.r, color.g, color.b});
  }
  const double texel = Luminance(mean) / std::max(Luminance(factor), 1e-9);
  const auto shown = [&](double gain) {
    const double stored = gain > 1 ? Develop({texel, texel, texel}, {gain}).g : texel;
    double sum = 0;
    for (double color : wanted) sum += stored * std::min(color / gain, 1.0);
    return gain > 1 ? sum : sum * kPlainShare;
  };
  return *std::max_element(std::begin(kGains), std::end(kGains),
                           [&](double a, double b) { return shown(a) < shown(b); });
}

// The roll-off is that of the patch as a whole: its luminance, before and after.
TextureLight::Corner TextureLight::Ungained(PatchIndex i, int corner) const {
  const PlacedSurface& surface = placed_.surfaces[placed_.SurfaceOf(triangle_[i])];
  const Primitive& primitive = PrimitiveOf(*scene_, surface);
  const Material& material = scene_->materials[material_[i]];
  const SurfaceTriangle& triangle = placed_.triangles[triangle_[i]];
  const Vec3 weights = WeightsAt(triangle.corners, patches_.corners[i][corner]);
  const Rgb irradiance = corner_irradiance_lx_[i][corner];
  const Rgb radiosity = patches_.exitance_lm_per_m2[i] + patches_.reflectance[i] * irradiance;
  const double exposed = Luminance(radiosity) * exposure_.per_lm_per_m2;
  const double rolled_off = exposed > 0 ? Luminance(Develop(radiosity, exposure_)) / exposed : 1;
  Corner made;
  made.uv = UvAt(material.reflectance_texture, primitive, triangle.vertices, weights);
  for (int channel = 0; channel < 3; ++channel) {
    const double painted = primitive.colors.empty()
                               ? 1
                               : Interpolate(weights, primitive.colors, triangle.vertices, channel);
    const double reflected =
        std::min(material.reflectance[channel], 1.0) * painted * irradiance[channel];
    made.color[channel] = (material.luminance[channel] * std::numbers::pi + reflected) *
                          exposure_.per_lm_per_m2 * rolled_off;
  }
  if (!primitive.colors.empty()) {
    made.alpha = Interpolate(weights, primitive.colors, triangle.vertices, 3);
  }
  return made;
}

TextureLight::Corner TextureLight::At(PatchIndex i, int corner) const {
  Corner made = Ungained(i, corner);
  made.color = made.color / gain_[i];
  return made;
}

GlbWriter::Json TextureLight::MakeMaterial(int material, double gain, Copies& copies,
                                           GlbWriter& writer) const {
  const Material& source = scene_->materials[material];
  const int shown = source.reflectance_texture.texture;
  const auto [copy, is_new] = copies.try_emplace({shown, gain}, 0);
  if (is_new) {
    const Texture& texture = scene_->textures[shown];
    const ImageBytes image = EncodeTexture(texture, gain);
    copy->second = writer.AddTexture(
        image.bytes, image.mime_type,
        {{"wrapS", WrapCode(texture.wrap_u)}, {"wrapT", WrapCode(texture.wrap_v)}});
  }
  GlbWriter::Json made = writer.UnlitMaterial(source.name);
  made["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", copy->second}};
  made["extras"] = {{"gain", gain}};
  if (source.alpha_cutoff > 0) {
    made["alphaMode"] = "MASK";
    made["alphaCutoff"] = source.alpha_cutoff;
    made["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, std::clamp(source.alpha, 0.0, 1.0)};
  }
  return made;
}

}  // namespace lambert
