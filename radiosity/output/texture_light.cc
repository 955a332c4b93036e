#include "radiosity/output/texture_light.h"

#include <algorithm>
#include <cmath>

#include "radiosity/output/texture_image.h"

namespace lambert {
namespace {

// Of the corners of a material that its gain suffices for.
constexpr double kServedShare = 0.99;
constexpr double kMostGain = 16;

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
      material_(patches.corners.size(), -1) {
  if (scene == nullptr || scene->textures.empty()) return;
  placed_ = PlaceScene(*scene, patches.origin);
  triangle_ = FindTriangles(*scene, placed_, patches);
  gain_.assign(scene->materials.size(), 1);
  std::vector<std::vector<double>> wanted(scene->materials.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PlacedSurface& surface = placed_.surfaces[placed_.SurfaceOf(triangle_[i])];
    const int material = PrimitiveOf(*scene, surface).material;
    if (material < 0 || scene->materials[material].reflectance_texture.texture < 0) continue;
    if (patches.exitance_lm_per_m2[i] != Rgb{}) continue;
    material_[i] = material;
    for (int corner = 0; corner < 3; ++corner) {
      const Rgb color = Ungained(i, corner).color;
      wanted[material].push_back(std::max({color.r, color.g, color.b}));
    }
  }
  for (size_t material = 0; material < wanted.size(); ++material) {
    std::vector<double>& values = wanted[material];
    if (values.empty()) continue;
    const auto served = values.begin() + static_cast<std::ptrdiff_t>(
                                             kServedShare * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), served, values.end());
    gain_[material] = std::clamp(*served, 1.0, kMostGain);
  }
}

// The roll-off is that of the patch as a whole: its luminance, before and after.
TextureLight::Corner TextureLight::Ungained(PatchIndex i, int corner) const {
  const PlacedSurface& surface = placed_.surfaces[placed_.SurfaceOf(triangle_[i])];
  const Primitive& primitive = PrimitiveOf(*scene_, surface);
  const Material& material = scene_->materials[material_[i]];
  const SurfaceTriangle& triangle = placed_.triangles[triangle_[i]];
  const Vec3 weights = WeightsAt(triangle.corners, patches_.corners[i][corner]);
  const Rgb irradiance = corner_irradiance_lx_[i][corner];
  const Rgb radiosity = patches_.reflectance[i] * irradiance;
  const double exposed = Luminance(radiosity) * exposure_.per_lm_per_m2;
  const double rolled_off = exposed > 0 ? Luminance(Develop(radiosity, exposure_)) / exposed : 1;
  Corner made;
  made.uv = UvAt(material.reflectance_texture, primitive, triangle.vertices, weights);
  for (int channel = 0; channel < 3; ++channel) {
    const double painted = primitive.colors.empty()
                               ? 1
                               : Interpolate(weights, primitive.colors, triangle.vertices, channel);
    made.color[channel] = std::min(material.reflectance[channel], 1.0) * painted *
                          irradiance[channel] * exposure_.per_lm_per_m2 * rolled_off;
  }
  if (!primitive.colors.empty()) {
    made.alpha = Interpolate(weights, primitive.colors, triangle.vertices, 3);
  }
  return made;
}

TextureLight::Corner TextureLight::At(PatchIndex i, int corner) const {
  Corner made = Ungained(i, corner);
  made.color = made.color / gain_[material_[i]];
  return made;
}

GlbWriter::Json TextureLight::MakeMaterial(int material, GlbWriter& writer) const {
  const Material& source = scene_->materials[material];
  const Texture& texture = scene_->textures[source.reflectance_texture.texture];
  const ImageBytes image = EncodeTexture(texture, gain_[material]);
  const size_t index =
      writer.AddTexture(image.bytes, image.mime_type,
                        {{"wrapS", WrapCode(texture.wrap_u)}, {"wrapT", WrapCode(texture.wrap_v)}});
  GlbWriter::Json made = writer.UnlitMaterial(source.name);
  made["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", index}};
  made["extras"] = {{"gain", gain_[material]}};
  if (source.alpha_cutoff > 0) {
    made["alphaMode"] = "MASK";
    made["alphaCutoff"] = source.alpha_cutoff;
    made["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, std::clamp(source.alpha, 0.0, 1.0)};
  }
  return made;
}

}  // namespace lambert
