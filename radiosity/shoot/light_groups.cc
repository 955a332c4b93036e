#include "radiosity/shoot/light_groups.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "radiosity/shoot/emitter.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1 << 20;
constexpr int64_t kMinRaysOfPatch = 16, kMaxRaysOfPatch = RayBatch::kCapacity;

// Disjoint sets (Galler, Fischer 64); the root of each is its least member.
class Groups {
 public:
  explicit Groups(PatchIndex count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  PatchIndex Root(PatchIndex i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(PatchIndex a, PatchIndex b) {
    a = Root(a);
    b = Root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<PatchIndex> parent_;
};

}  // namespace

std::vector<int32_t> FindLightGroups(const PatchSet& patches, const RayScene& scene) {
  const PatchIndex count = patches.size();
  const auto rays = static_cast<uint32_t>(
      std::clamp(kRays / std::max<int64_t>(1, count), kMinRaysOfPatch, kMaxRaysOfPatch));
  const Emitters emitters(patches, scene);
  Groups groups(count);
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
    const PatchIndex root = groups.Root(i);
    number[i] = root == i ? next++ : number[root];
  }
  return number;
}

}  // namespace lambert
