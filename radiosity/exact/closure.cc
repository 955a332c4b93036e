#include "radiosity/exact/closure.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "radiosity/core/philox.h"
#include "radiosity/exact/polygon.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1 << 22, kMostRaysPerPatch = 4096;
// Rays start this far inside a patch's edges, as shooting ones do (docs/decisions/0004).
constexpr double kEdgeMargin = 1.0 / 131072;

// Appends a ray from a uniform point of the patch by the cosine law, or none where the numbers fall
// outside the unit disk.
void AppendRay(const Triangle& t, const std::array<float, 4>& numbers, const RayScene& scene,
               RayBatch& batch) {
  const double x = 2.0 * numbers[2] - 1, y = 2.0 * numbers[3] - 1, height2 = 1 - x * x - y * y;
  if (!(height2 > 0)) return;
  const double root = std::sqrt(numbers[0]), inner = 1 - 3 * kEdgeMargin;
  const double b1 = kEdgeMargin + inner * root * (1 - numbers[1]);
  const double b2 = kEdgeMargin + inner * root * numbers[1];
  const Vec3 normal = PlaneOf(t).normal, along = Normalized(t[1] - t[0]);
  const Vec3 origin =
      scene.ToTrace(t[0] + (t[1] - t[0]) * b1 + (t[2] - t[0]) * b2) + normal * kOriginOffset;
  const Vec3 direction = along * x + Cross(normal, along) * y + normal * std::sqrt(height2);
  batch.Add(origin, direction);
}

bool AllArrive(const RayScene& scene, RayBatch& batch) {
  scene.Trace(batch);
  const bool all = std::none_of(batch.hit, batch.hit + batch.size,
                                [](PatchIndex hit) { return hit == kEscaped; });
  batch.size = 0;
  return all;
}

}  // namespace

bool IsClosed(const PatchSet& patches, const RayScene& scene) {
  const auto rays =
      static_cast<uint32_t>(std::min<int64_t>(kRays / patches.size() + 1, kMostRaysPerPatch));
  auto batch = std::make_unique<RayBatch>();
  for (uint32_t ray = 0; ray < rays; ++ray) {  // a few of every patch first: most holes show soon
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      const RandomStream stream{0, static_cast<uint32_t>(i), 0, 0};
      AppendRay(patches.corners[i], RandomNumbers(stream, ray, RandomPurpose::kClosure), scene,
                *batch);
      if (batch->size == RayBatch::kCapacity && !AllArrive(scene, *batch)) return false;
    }
  }
  return AllArrive(scene, *batch);
}

}  // namespace lambert
