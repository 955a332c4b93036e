#include "radiosity/gather/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/core/sin_cos.h"
#include "radiosity/gather/lamp_tree.h"
#include "radiosity/patch/light.h"
#include "radiosity/shoot/ray_numbers.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// A pass of a solve that has this number would be its 65,536th: gathering has streams of its own.
constexpr uint32_t kGatherPass = 0xFFFF;
// What the rays of a point are for; lights count on.
constexpr int kHemisphere = 0, kLamp = 1, kFirstLight = 2;

// A right-handed frame around a unit normal (DBC17).
struct Frame {
  explicit Frame(Vec3 normal) : z(normal) {
    const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a;
    x = {1 + sign * z.x * z.x * a, sign * b, -sign * z.x};
    y = {b, sign + z.y * z.y * a, -z.y};
  }
  Vec3 x, y, z;
};

// A direction with density cos(theta) / pi by two numbers in [0, 1).
Vec3 CosineDirection(const Frame& frame, double xi1, double xi2) {
  const double radius = std::sqrt(xi1);
  const SineCosine turn = SinCos(2 * std::numbers::pi * (xi2 - 0.5));
  return frame.x * (radius * turn.cosine) + frame.y * (radius * turn.sine) +
         frame.z * std::sqrt(1 - xi1);
}

// Rays of any points, on their way, and what each brings to which sum where it arrives.
class Batch {
 public:
  bool full() const { return rays_.size == RayBatch::kCapacity; }
  void Add(Vec3 origin, Vec3 direction, Rgb value, Rgb* sum) {
    values_[rays_.size] = value;
    sums_[rays_.size] = sum;
    rays_.Add(origin, direction);
  }
  // Calls `trace(rays)`, then `land(hit, value, sum)` for each; then the batch is empty.
  template <typename Trace, typename Land>
  void Fly(Trace trace, Land land) {
    trace(rays_);
    for (int k = 0; k < rays_.size; ++k) land(rays_.hit[k], values_[k], *sums_[k]);
    rays_.size = 0;
  }

 private:
  RayBatch rays_;
  std::array<Rgb, RayBatch::kCapacity> values_;
  std::array<Rgb*, RayBatch::kCapacity> sums_;
};

// What all points of a scene have in common.
struct Source {
  Source(std::shared_ptr<const PatchSet> of, std::unique_ptr<RayScene> tracer,
         const GatherOptions& options)
      : patches(std::move(of)),
        scene(std::move(tracer)),
        lamps(*patches),
        seed(options.seed),
        rays((options.rays_per_point + kGatherReplicates - 1) / kGatherReplicates) {}

  const std::shared_ptr<const PatchSet> patches;
  const std::unique_ptr<const RayScene> scene;
  const LampTree lamps;
  std::vector<Rgb> reflected_lm_per_m2;
  const uint64_t seed;
  const int rays;  // of one kind, a replicate
};

// The sums of one range of points. Rays of each kind add to sums of their own, in the order of the
// rays: so nothing depends on where a batch ends.
class Sums {
 public:
  Sums(const Source& source, size_t count)
      : source_(source),
        hemisphere_(std::make_unique<Batch>()),
        shadow_(std::make_unique<Batch>()),
        reflected_(count * kGatherReplicates),
        direct_(count * kGatherReplicates),
        lights_(count) {}

  void Add(Vec3 position, Vec3 normal, uint32_t name, size_t slot) {
    const double length = Length(normal);
    if (!IsFinite(position) || !std::isfinite(length) || length == 0) return;
    const Frame frame(normal / length);
    const Vec3 origin = source_.scene->ToTrace(position) + frame.z * kOriginOffset;
    const LampTree::Cut cut = source_.lamps.CutFor(position, frame.z);
    for (int replicate = 0; replicate < kGatherReplicates; ++replicate) {
      const size_t sum = slot * kGatherReplicates + replicate;
      AddHemisphere(frame, origin, Numbers(name, replicate, kHemisphere), &reflected_[sum]);
      if (!cut.lit()) continue;
      AddLamps(position, frame.z, origin, cut, Numbers(name, replicate, kLamp), &direct_[sum]);
    }
    const int lights = LightCount(*source_.patches);
    for (int light = 0; light < lights; ++light)
      AddLight(light, position, frame.z, origin, name, slot);
  }

  Gathered Finish() {
    FlyHemisphere();
    FlyShadows();
    Gathered gathered;
    for (size_t i = 0; i < lights_.size(); ++i) {
      Rgb mean, deviation;
      std::array<Rgb, kGatherReplicates> parts;
      for (int r = 0; r < kGatherReplicates; ++r) {
        const size_t sum = i * kGatherReplicates + r;
        parts[r] = (reflected_[sum] + direct_[sum]) / source_.rays;
        mean = mean + parts[r] / kGatherReplicates;
      }
      for (const Rgb& part : parts) deviation = deviation + (part - mean) * (part - mean);
      for (int c = 0; c < 3; ++c) {
        deviation[c] = std::sqrt(deviation[c] / (kGatherReplicates * (kGatherReplicates - 1)));
      }
      gathered.irradiance_lx.push_back(mean + lights_[i]);
      gathered.std_error_lx.push_back(deviation);
    }
    return gathered;
  }

 private:
  RayNumbers Numbers(uint32_t name, int replicate, int purpose) const {
    const int stream = purpose * kGatherReplicates + replicate;
    return {RandomStream{source_.seed, name, static_cast<uint32_t>(stream), kGatherPass},
            Sequence::kSobol};
  }

  void AddHemisphere(const Frame& frame, Vec3 origin, const RayNumbers& numbers, Rgb* sum) {
    RandomNumbers8 xi;
    for (int ray = 0; ray < source_.rays; ++ray) {
      if (ray % 8 == 0) numbers.Fill(static_cast<uint32_t>(ray), xi);
      const int lane = ray % 8;
      const Vec3 way = CosineDirection(frame, xi.numbers[0][lane], xi.numbers[1][lane]);
      hemisphere_->Add(origin, way, {}, sum);
      if (hemisphere_->full()) FlyHemisphere();
    }
  }

  void AddLamps(Vec3 position, Vec3 normal, Vec3 origin, const LampTree::Cut& cut,
                const RayNumbers& numbers, Rgb* sum) {
    const PatchSet& patches = *source_.patches;
    RandomNumbers8 xi;
    for (int ray = 0; ray < source_.rays; ++ray) {
      if (ray % 8 == 0) numbers.Fill(static_cast<uint32_t>(ray), xi);
      const int lane = ray % 8;
      double chosen = xi.numbers[0][lane];
      const LampTree::Choice choice = cut.Pick(chosen);
      if (choice.lamp == kNoPatch) continue;
      const LampSample sample = SampleLamp(patches, choice.lamp, position, normal,
                                           xi.numbers[1][lane], xi.numbers[2][lane]);
      if (ChannelSum(sample.irradiance_lx) == 0) continue;
      const Vec3 end = source_.scene->ToTrace(position + sample.to_lamp);
      // Of points far outside the scene the rays are as much coarser.
      const double lift = kTieDistance * std::max(1.0, Length(end - origin) / 2);
      AddShadowRay(origin, end + PatchNormal(patches, choice.lamp) * lift,
                   sample.irradiance_lx / choice.probability, sum);
    }
  }

  // One ray where more would say the same.
  void AddLight(int light, Vec3 position, Vec3 normal, Vec3 origin, uint32_t name, size_t slot) {
    if (IsDelta(*source_.patches, light)) {
      AddLightRay(SampleLight(*source_.patches, light, position, 0, 0), normal, origin,
                  &lights_[slot]);
      return;
    }
    for (int replicate = 0; replicate < kGatherReplicates; ++replicate) {
      const RayNumbers numbers = Numbers(name, replicate, kFirstLight + light);
      RandomNumbers8 xi;
      for (int ray = 0; ray < source_.rays; ++ray) {
        if (ray % 8 == 0) numbers.Fill(static_cast<uint32_t>(ray), xi);
        AddLightRay(SampleLight(*source_.patches, light, position, xi.numbers[0][ray % 8],
                                xi.numbers[1][ray % 8]),
                    normal, origin, &direct_[slot * kGatherReplicates + replicate]);
      }
    }
  }

  void AddLightRay(const LightSample& sample, Vec3 normal, Vec3 origin, Rgb* sum) {
    const double cosine = Dot(sample.direction, normal);
    if (!(cosine > 0) || ChannelSum(sample.illuminance_lx) == 0) return;
    // Past everything: the scene's diagonal is less than 2.
    const double past = Length(origin) + 2;
    const double length = std::min(sample.distance_m * source_.scene->scale(), past);
    AddShadowRay(origin, origin + sample.direction * length, sample.illuminance_lx * cosine, sum);
  }

  void AddShadowRay(Vec3 origin, Vec3 end, Rgb value, Rgb* sum) {
    shadow_->Add(origin, end - origin, value, sum);
    if (shadow_->full()) FlyShadows();
  }

  void FlyHemisphere() {
    hemisphere_->Fly([&](RayBatch& rays) { source_.scene->Trace(rays); },
                     [&](PatchIndex hit, Rgb, Rgb& sum) {
                       if (hit >= 0) sum = sum + source_.reflected_lm_per_m2[hit];
                     });
  }

  void FlyShadows() {
    shadow_->Fly([&](RayBatch& rays) { source_.scene->Occlude(rays); },
                 [&](PatchIndex hit, Rgb value, Rgb& sum) {
                   if (hit != kBlocked) sum = sum + value;
                 });
  }

  const Source& source_;
  const std::unique_ptr<Batch> hemisphere_, shadow_;
  std::vector<Rgb> reflected_, direct_, lights_;
};

}  // namespace

struct Gatherer::Impl : Source {
  using Source::Source;
};

absl::StatusOr<std::shared_ptr<const Gatherer>> Gatherer::Create(
    std::shared_ptr<const PatchSet> patches, const std::vector<Rgb>& radiosity_lm_per_m2,
    const GatherOptions& options) {
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  auto impl = std::make_unique<Impl>(std::move(patches), *std::move(scene), options);
  for (size_t i = 0; i < radiosity_lm_per_m2.size(); ++i) {
    Rgb reflected = radiosity_lm_per_m2[i] - impl->patches->exitance_lm_per_m2[i];
    for (int c = 0; c < 3; ++c) reflected[c] = std::max(reflected[c], 0.0);  // rounding
    impl->reflected_lm_per_m2.push_back(reflected);
  }
  return std::shared_ptr<const Gatherer>(new Gatherer(std::move(impl)));
}

Gatherer::Gatherer(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
Gatherer::~Gatherer() = default;

Gathered Gatherer::Run(const GatherPoints& points, size_t begin, size_t end,
                       uint32_t first_name) const {
  const DenormalsFlushed flushed;
  Sums sums(*impl_, end - begin);
  for (size_t i = begin; i < end; ++i) {
    sums.Add(points.position_m[i], points.normal[i], first_name + static_cast<uint32_t>(i),
             i - begin);
  }
  return sums.Finish();
}

absl::StatusOr<GatherFunction> GatherHere(std::shared_ptr<const PatchSet> patches,
                                          const std::vector<Rgb>& radiosity_lm_per_m2,
                                          const GatherOptions& options) {
  auto gatherer = Gatherer::Create(std::move(patches), radiosity_lm_per_m2, options);
  if (!gatherer.ok()) return gatherer.status();
  return [gatherer = *std::move(gatherer)](const GatherPoints& points) -> absl::StatusOr<Gathered> {
    return gatherer->Run(points, 0, points.size());
  };
}

}  // namespace lambert
