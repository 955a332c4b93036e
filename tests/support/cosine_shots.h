// Rays as emitters shoot them, and what they hit: for tests of the tracer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Calls `use(emitter, hit)` for `rays` cosine rays, dealt evenly over the fronts of the patches for
// which `chosen(patch)`; the same rays for the same patches at any scale.
template <typename Chosen, typename Use>
void ShootCosineRays(const PatchSet& patches, const RayScene& scene, int64_t rays, Chosen chosen,
                     Use use) {
  const Emitters emitters(patches, scene);
  std::vector<PatchIndex> from;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!patches.is_back[i] && chosen(i)) from.push_back(i);
  }
  const auto each =
      static_cast<uint32_t>(std::max<int64_t>(1, rays / static_cast<int64_t>(from.size())));
  auto batch = std::make_unique<RayBatch>();
  std::vector<PatchIndex> emitter;
  const auto land = [&] {
    scene.Trace(*batch);
    for (int k = 0; k < batch->size; ++k) use(emitter[k], batch->hit[k]);
    batch->size = 0;
    emitter.clear();
  };
  for (PatchIndex i : from) {
    const EmitterFrame frame = emitters.Frame(i);
    for (uint32_t ray = 0; ray < each;) {
      const uint32_t end = std::min<uint32_t>(each, ray + RayBatch::kCapacity - batch->size);
      AppendCosineRays(frame, RandomStream{1, static_cast<uint32_t>(i), 0, 0}, ray, end, *batch);
      emitter.resize(batch->size, i);
      ray = end;
      if (batch->size == RayBatch::kCapacity) land();
    }
  }
  land();
}

// How many rays left the scene.
struct Losses {
  int64_t rays = 0, escaped = 0;
};
inline Losses CountLosses(const PatchSet& patches, int64_t rays) {
  const auto scene = *RayScene::Create(patches);
  Losses losses;
  ShootCosineRays(
      patches, *scene, rays, [](PatchIndex) { return true; },
      [&](PatchIndex, PatchIndex hit) {
        ++losses.rays;
        losses.escaped += hit == kEscaped;
      });
  return losses;
}

}  // namespace lambert
