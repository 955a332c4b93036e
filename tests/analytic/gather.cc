#include "tests/analytic/gather.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

class Walker {
 public:
  Walker(const PatchSet& patches, uint64_t seed)
      : patches_(patches), scene_(*RayScene::Create(patches)), random_(seed) {}

  // Emission that `walks` paths from patch i meet, per path.
  std::vector<double> Walk(PatchIndex i, int walks) {
    std::vector<double> met(walks, 0.0);
    std::vector<int> path(walks);       // which path each ray belongs to
    std::vector<PatchIndex> at(walks);  // and the patch that it leaves from
    for (int k = 0; k < walks; ++k) {
      path[k] = k;
      at[k] = i;
    }
    while (!path.empty()) {
      std::vector<int> next_path;
      std::vector<PatchIndex> next_at;
      for (size_t first = 0; first < path.size(); first += RayBatch::kCapacity) {
        const size_t count = std::min<size_t>(RayBatch::kCapacity, path.size() - first);
        batch_->size = static_cast<int>(count);
        for (size_t k = 0; k < count; ++k) Emit(at[first + k], static_cast<int>(k));
        scene_->Trace(*batch_);
        for (size_t k = 0; k < count; ++k) {
          const PatchIndex hit = batch_->hit[k];
          if (hit < 0) continue;
          met[path[first + k]] += patches_.exitance_lm_per_m2[hit].r;
          if (uniform_(random_) >= patches_.reflectance[hit].r) continue;
          next_path.push_back(path[first + k]);
          next_at.push_back(hit);
        }
      }
      path.swap(next_path);
      at.swap(next_at);
    }
    return met;
  }

 private:
  void Emit(PatchIndex i, int slot) {
    double u = uniform_(random_), v = uniform_(random_);
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto& c = patches_.corners[i];
    const Vec3 z = PatchNormal(patches_, i), x = Normalized(c[1] - c[0]), y = Cross(z, x);
    const Vec3 o = scene_->ToTrace(c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0])) +
                   static_cast<double>(kOriginOffset) * z;
    const double angle = 2 * std::numbers::pi * uniform_(random_), s2 = uniform_(random_);
    const double sine = std::sqrt(s2);
    const Vec3 d = sine * std::cos(angle) * x + sine * std::sin(angle) * y + std::sqrt(1 - s2) * z;
    batch_->origin_x[slot] = static_cast<float>(o.x);
    batch_->origin_y[slot] = static_cast<float>(o.y);
    batch_->origin_z[slot] = static_cast<float>(o.z);
    batch_->direction_x[slot] = static_cast<float>(d.x);
    batch_->direction_y[slot] = static_cast<float>(d.y);
    batch_->direction_z[slot] = static_cast<float>(d.z);
  }

  const PatchSet& patches_;
  std::unique_ptr<RayScene> scene_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_;
  std::unique_ptr<RayBatch> batch_ = std::make_unique<RayBatch>();
};

}  // namespace

Walked GatherByWalks(const PatchSet& patches, int walks_per_patch, uint64_t seed) {
  Walker walker(patches, seed);
  Walked gathered;
  const double n = walks_per_patch;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const std::vector<double> met = walker.Walk(i, walks_per_patch);
    double sum = 0, squares = 0;
    for (double m : met) sum += m;
    for (double m : met) squares += (m - sum / n) * (m - sum / n);
    const double rho = patches.reflectance[i].r;
    gathered.radiosity.push_back(patches.exitance_lm_per_m2[i].r + rho * sum / n);
    gathered.std_error.push_back(rho * std::sqrt(squares / (n - 1) / n));
  }
  return gathered;
}

}  // namespace lambert
