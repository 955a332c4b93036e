#include "radiosity/output/surface_reader.h"

#include <algorithm>
#include <utility>

#include "radiosity/patch/texture_mean.h"

namespace lambert {
namespace {

bool Varies(const Scene& scene) {
  const auto has_colors = [](const Mesh& mesh) {
    return std::any_of(mesh.primitives.begin(), mesh.primitives.end(),
                       [](const Primitive& primitive) { return !primitive.colors.empty(); });
  };
  return !scene.textures.empty() ||
         std::any_of(scene.meshes.begin(), scene.meshes.end(), has_colors);
}

// A triangle that shows one point everywhere.
PaintedTriangle PointOf(const Scene& scene, const TextureUse& use, const Primitive& primitive,
                        const SurfaceTriangle& triangle, Vec3 weights) {
  PaintedTriangle point;
  if (use.texture < 0) return point;
  point.texture = &scene.textures[use.texture];
  point.uv.fill(UvAt(use, primitive, triangle.vertices, weights));
  return point;
}

void SetColor(const Primitive& primitive, const SurfaceTriangle& triangle, Vec3 weights,
              PaintedTriangle& point) {
  if (primitive.colors.empty()) return;
  for (int c = 0; c < 4; ++c) {
    const double value = Interpolate(weights, primitive.colors, triangle.vertices, c);
    for (auto& color : point.colors) color[c] = std::clamp(static_cast<float>(value), 0.0f, 1.0f);
  }
}

}  // namespace

SurfaceReader::SurfaceReader(const PatchSet& patches, const Scene* scene)
    : patches_(patches), scene_(scene) {
  if (scene == nullptr || !Varies(*scene)) return;
  std::vector<Warning> warnings;  // said when the patches were built
  absl::StatusOr<std::vector<PatchMaterial>> materials = MakePatchMaterials(*scene, {}, &warnings);
  if (!materials.ok()) return;
  materials_ = *std::move(materials);
  placed_ = PlaceScene(*scene, patches.origin);
  triangle_ = FindTriangles(*scene, placed_, patches);
}

std::optional<TexelSurface> SurfaceReader::At(PatchIndex i, Vec3 weights) const {
  const TexelSurface mean{patches_.reflectance[i], patches_.exitance_lm_per_m2[i]};
  if (triangle_.empty()) return mean;
  const SurfaceTriangle& triangle = placed_.triangles[triangle_[i]];
  const PlacedSurface& surface = placed_.surfaces[placed_.SurfaceOf(triangle_[i])];
  const Primitive& primitive = PrimitiveOf(*scene_, surface);
  const PatchMaterial& material = materials_[primitive.material + 1];
  const bool textured =
      material.reflectance_texture.texture >= 0 || material.exitance_texture.texture >= 0;
  if (!textured && primitive.colors.empty()) return mean;
  const auto& corners = patches_.corners[i];
  const Vec3 in_triangle = WeightsAt(
      triangle.corners, corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z);
  PaintedTriangle paint =
      PointOf(*scene_, material.reflectance_texture, primitive, triangle, in_triangle);
  SetColor(primitive, triangle, in_triangle, paint);
  const MaskedMean reflected = MeanOver(paint, 1, material.alpha, material.alpha_cutoff);
  if (reflected.coverage == 0) return std::nullopt;
  const PaintedTriangle light =
      PointOf(*scene_, material.exitance_texture, primitive, triangle, in_triangle);
  return TexelSurface{material.reflectance * reflected.mean,
                      material.exitance_lm_per_m2 * MeanOver(light, 1).mean};
}

}  // namespace lambert
