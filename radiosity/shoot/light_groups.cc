#include "radiosity/shoot/light_groups.h"

#include <algorithm>
#include <memory>

#include "radiosity/core/disjoint_sets.h"
#include "radiosity/shoot/emitter.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1 << 20;
constexpr int64_t kMinRaysOfPatch = 16, kMaxRaysOfPatch = RayBatch::kCapacity;

int64_t RaysOfPatch(PatchIndex patches) {
  return std::clamp(kRays / std::max<int64_t>(1, patches), kMinRaysOfPatch, kMaxRaysOfPatch);
}

}  // namespace

int64_t LightGroupRays(PatchIndex patches) { return patches * RaysOfPatch(patches); }

std::vector<int32_t> FindLightGroups(const PatchSet& patches, const RayScene& scene) {
  const PatchIndex count = patches.size();
  const auto rays = static_cast<uint32_t>(RaysOfPatch(count));
  const Emitters emitters(patches, scene);
  DisjointSets groups(count);
  auto batch = std::make_unique<RayBatch>();
  for (PatchIndex i = 0; i < count; ++i) {
    batch->size = 0;
    AppendCosineRays(emitters.Frame(i), RandomStream{0, static_cast<uint32_t>(i), 0, 0}, 0, rays,
                     *batch);
    scene.Trace(*batch);
    for (int k = 0; k < batch->size; ++k) {
      if (batch->hit[k] >= 0) groups.Join(i, batch->hit[k]);
    }
  }
  std::vector<int32_t> number(count);
  int32_t next = 0;
  for (PatchIndex i = 0; i < count; ++i) {
    const PatchIndex root = groups.Find(i);
    number[i] = root == i ? next++ : number[root];
  }
  return number;
}

}  // namespace lambert
