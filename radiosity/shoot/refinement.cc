#include "radiosity/shoot/refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "radiosity/patch/cone.h"
#include "radiosity/patch/light.h"

namespace lambert {
namespace {

// Grazing light changes fast along a surface: a cosine counts as no less.
constexpr float kLeastCosine = 0.1f;
constexpr float kPi = std::numbers::pi_v<float>;

float Dot3(const float a[3], const float b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

Refinement::Refinement(const PatchSet& patches, const RayScene& scene, const SurfaceTree& tree,
                       const PyramidOptions& options)
    : flux_(static_cast<float>(options.hier_flux)),
      size_(static_cast<float>(options.hier_size)),
      per_area_(1 / (scene.scale() * scene.scale())),
      leaves_(patches.size()) {
  const double scale = scene.scale(), area_scale = scale * scale;
  std::vector<float> surface;  // of each element
  for (const Element& element : tree.elements()) {
    const auto area = static_cast<float>(element.area_m2 * area_scale);
    nodes_.push_back({area, static_cast<float>(element.radius_m * scale), element.parent});
    surface.push_back(element.parent < 0 ? area : surface[element.parent]);
  }
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    Leaf& leaf = leaves_[i];
    ToFloats(scene.ToTrace(PatchCentroid(patches, i)), leaf.centroid);
    ToFloats(PatchNormal(patches, i), leaf.normal);
    leaf.area = static_cast<float>(patches.area_m2[i] * area_scale);
    leaf.parent = tree.ParentOf(i);
    leaf.surface = leaf.parent < 0 ? leaf.area : surface[leaf.parent];
  }
  const Bounds box = BoundsOf(patches);
  for (const Light& light : patches.lights) {
    double extent = 0;
    if (light.kind == Light::Kind::kPoint) {
      extent = Cone(light.cos_inner, light.cos_outer).SolidAngle();
    } else if (light.kind == Light::Kind::kLamp) {
      extent = light.table->total().r / std::max(light.table->Greatest(), 1e-300);
    } else {
      const bool is_sky = light.kind == Light::Kind::kSky;
      extent = (is_sky ? DiskArea(box) : ProjectedArea(box, light.z)) * area_scale;
    }
    beams_.push_back({!HasPlace(light), static_cast<float>(extent)});
  }
}

float Refinement::MostArea(const Visit& visit, float rays_per_area, const float direction[3],
                           float distance, float cosine) const {
  const float square = kPi * distance * distance;
  if (static_cast<size_t>(visit.emitter) >= leaves_.size()) {
    const Beam& beam = beams_[visit.emitter - leaves_.size()];
    const float width = beam.is_parallel ? beam.extent : beam.extent * distance * distance;
    return flux_ * width / (static_cast<float>(visit.ray_count) * cosine);
  }
  const Leaf& source = leaves_[visit.emitter];
  const float leaving = std::max(kLeastCosine, Dot3(direction, source.normal) / distance);
  const float own = static_cast<float>(visit.ray_count - 1) / source.area;
  const float pairs = flux_ * square / (std::max(own, rays_per_area) * leaving * cosine);
  const float alike = std::sqrt(pairs);  // as large as the part of the source
  return alike <= source.surface ? alike : pairs / source.surface;
}

PatchIndex Refinement::Place(const Visit& visit, double unit_rays_per_m2, const RayBatch& batch,
                             int slot) const {
  const PatchIndex hit = batch.hit[slot];
  const Leaf& leaf = leaves_[hit];
  if (leaf.parent < 0) return hit;
  const float direction[3] = {leaf.centroid[0] - batch.origin_x[slot],
                              leaf.centroid[1] - batch.origin_y[slot],
                              leaf.centroid[2] - batch.origin_z[slot]};
  const float distance =
      std::max(std::sqrt(Dot3(direction, direction)), std::numeric_limits<float>::min());
  const float cosine = std::max(kLeastCosine, -Dot3(direction, leaf.normal) / distance);
  const float most_area = MostArea(visit, static_cast<float>(unit_rays_per_m2 * per_area_),
                                   direction, distance, cosine);
  const float most_radius = size_ * distance;
  int32_t at = -1;
  for (int32_t e = leaf.parent; e >= 0; e = nodes_[e].parent) {
    if (nodes_[e].area > most_area || nodes_[e].radius > most_radius) break;
    at = e;
  }
  return at < 0 ? hit : static_cast<PatchIndex>(leaves_.size()) + at;
}

}  // namespace lambert
