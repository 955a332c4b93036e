#include "radiosity/shoot/shooter.h"

#include <gnu/libc-version.h>
#include <pmmintrin.h>
#include <time.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/density_table.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// Changes whenever the same unit would give other bytes.
constexpr char kCodeVersion[] = "shoot-1";

// Flushes denormals while it lives: they are slow, and different where a thread forgets to.
class DenormalsFlushed {
 public:
  DenormalsFlushed() : saved_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~DenormalsFlushed() { _mm_setcsr(saved_); }

 private:
  unsigned saved_;
};

double ThreadCpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Rays of any emitters on their way to being traced and deposited together.
class Flight {
 public:
  Flight(const RayScene& scene, Arrivals& arrivals, UnitResult& result)
      : scene_(scene), arrivals_(arrivals), result_(result) {}

  RayBatch& batch() { return batch_; }
  float* cosine() { return cosine_; }
  // Rays that fit before the batch has to land; lands it when none fits.
  uint32_t Room() {
    if (batch_.size == RayBatch::kCapacity) Land();
    return static_cast<uint32_t>(RayBatch::kCapacity - batch_.size);
  }
  void SetFlux(int slot, int channel, int64_t quanta) { flux_[channel][slot] = quanta; }

  // Traces, deposits and empties the batch.
  void Land() {
    scene_.Trace(batch_);
    constexpr int kAhead = 16;  // deposits are random accesses: fetch them early
    for (int k = 0; k < batch_.size; ++k) {
      const PatchIndex next = batch_.hit[std::min(k + kAhead, batch_.size - 1)];
      if (next >= 0) arrivals_.Prefetch(next);
      Arrive(batch_.hit[k], flux_[0][k], flux_[1][k], flux_[2][k]);
    }
    result_.rays += batch_.size;
    batch_.size = 0;
  }

 private:
  void Arrive(PatchIndex hit, int64_t r, int64_t g, int64_t b) {
    result_.shot[0] += r;
    result_.shot[1] += g;
    result_.shot[2] += b;
    if (hit >= 0) {
      arrivals_.Add(hit, r, g, b);
      return;
    }
    result_.escaped[0] += r;
    result_.escaped[1] += g;
    result_.escaped[2] += b;
  }

  const RayScene& scene_;
  Arrivals& arrivals_;
  UnitResult& result_;
  RayBatch batch_;
  alignas(64) float cosine_[RayBatch::kSlots];
  alignas(64) int64_t flux_[3][RayBatch::kSlots];
};

// Quanta dealt over rays exactly: the quotient each, one extra to the first `remainder` rays.
struct Deal {
  int64_t quotient, remainder;
  Deal(int64_t quanta, int64_t rays) : quotient(quanta / rays), remainder(quanta % rays) {}
  int64_t Of(int64_t ray) const { return quotient + (ray < remainder ? 1 : 0); }
};

class EmbreeShooter : public Shooter {
 public:
  EmbreeShooter(std::shared_ptr<const PatchSet> patches, const ShootOptions& options,
                std::unique_ptr<RayScene> scene)
      : patches_(std::move(patches)),
        options_(options),
        scene_(std::move(scene)),
        emitters_(*patches_, *scene_),
        arrivals_(patches_->size()) {
    if (options_.method == Method::kPhs) {
      densities_ = std::make_unique<DensityTable>(*patches_, options_.pyramids);
    }
  }

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override;

 private:
  absl::Status Check(const WorkUnit& unit) const;
  void ShootVisit(const Visit& visit, const RandomStream& stream, Flight& flight) const;
  void ShootPyramids(const Visit& visit, const RandomStream& stream, Flight& flight) const;
  // Rays [begin, end) of one pyramid; `first`: its first ray within the visit; `share`: its rays,
  // or the expected number where that is under 1.
  void ShootPyramid(const EmitterFrame& frame, int pyramid, const Visit& visit,
                    const RandomStream& stream, uint32_t first, uint32_t begin, uint32_t end,
                    double share, Flight& flight) const;

  std::shared_ptr<const PatchSet> patches_;
  const ShootOptions options_;
  std::unique_ptr<RayScene> scene_;
  const Emitters emitters_;
  mutable ArrivalsPool arrivals_;
  std::unique_ptr<DensityTable> densities_;
};

absl::Status EmbreeShooter::Check(const WorkUnit& unit) const {
  for (const Visit& v : unit.visits) {
    const bool in_range = v.emitter >= 0 && v.emitter < emitters_.size() &&
                          v.ray_begin <= v.ray_end && v.ray_end <= v.ray_count;
    if (!in_range || v.quanta[0] < 0 || v.quanta[1] < 0 || v.quanta[2] < 0) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", "work unit, emitter " + std::to_string(v.emitter),
                        "its rays or quanta are out of range", "send units of this patch set"});
    }
  }
  if (unit.pass >= 1u << 16) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "work unit", "pass is 65536 or more", "use fewer passes"});
  }
  return absl::OkStatus();
}

absl::StatusOr<UnitResult> EmbreeShooter::Run(const WorkUnit& unit) const {
  if (absl::Status status = Check(unit); !status.ok()) return status;
  const DenormalsFlushed flushed;
  const double start = ThreadCpuSeconds();
  UnitResult result;
  std::unique_ptr<Arrivals> arrivals = arrivals_.Borrow();
  auto flight = std::make_unique<Flight>(*scene_, *arrivals, result);
  for (const Visit& visit : unit.visits) {
    const RandomStream stream{unit.seed, static_cast<uint32_t>(visit.emitter), unit.step,
                              unit.pass};
    const bool pyramids = densities_ != nullptr && !emitters_.IsPointLight(visit.emitter) &&
                          visit.ray_count >= densities_->min_rays();
    if (pyramids) {
      ShootPyramids(visit, stream, *flight);
    } else {
      ShootVisit(visit, stream, *flight);
    }
  }
  flight->Land();
  result.deposits = arrivals->Take();
  arrivals_.Return(std::move(arrivals));
  result.cpu_seconds = ThreadCpuSeconds() - start;
  return result;
}

void EmbreeShooter::ShootVisit(const Visit& visit, const RandomStream& stream,
                               Flight& flight) const {
  if (visit.ray_begin == visit.ray_end) return;
  const bool point = emitters_.IsPointLight(visit.emitter);
  const EmitterFrame frame = point ? EmitterFrame{} : emitters_.Frame(visit.emitter);
  const Deal deal[3] = {{visit.quanta[0], visit.ray_count},
                        {visit.quanta[1], visit.ray_count},
                        {visit.quanta[2], visit.ray_count}};
  for (uint32_t ray = visit.ray_begin; ray < visit.ray_end;) {
    const uint32_t until = ray + std::min(flight.Room(), visit.ray_end - ray);
    const int slot = flight.batch().size;
    if (point) {
      AppendSphereRays(emitters_.Position(visit.emitter), stream, ray, until, flight.batch());
    } else {
      AppendCosineRays(frame, stream, ray, until, flight.batch());
    }
    for (int c = 0; c < 3; ++c) {
      for (uint32_t k = ray; k < until; ++k) {
        flight.SetFlux(slot + static_cast<int>(k - ray), c, deal[c].Of(k));
      }
    }
    ray = until;
  }
}

void EmbreeShooter::ShootPyramids(const Visit& visit, const RandomStream& stream,
                                  Flight& flight) const {
  const std::vector<float> densities = densities_->Get(visit.emitter);
  const double offset = RandomNumbers(stream, 0, RandomPurpose::kPyramidOffset)[0];
  const std::vector<uint32_t> rays = PyramidRays(densities, visit.ray_count, offset);
  double sum = 0;
  for (float density : densities) sum += density;
  const EmitterFrame frame = emitters_.Frame(visit.emitter);
  uint32_t first = 0;
  for (size_t p = 0; p < rays.size(); ++p) {
    const uint32_t begin = std::max(first, visit.ray_begin);
    const uint32_t end = std::min(first + rays[p], visit.ray_end);
    const double expected = densities[p] / sum * visit.ray_count;
    // A pyramid that expects less than one ray gets one with that probability, which then carries
    // the flux of all the times it gets none.
    const double share = expected < 1 ? expected : rays[p];
    if (begin < end) {
      ShootPyramid(frame, static_cast<int>(p), visit, stream, first, begin, end, share, flight);
    }
    first += rays[p];
  }
}

void EmbreeShooter::ShootPyramid(const EmitterFrame& frame, int p, const Visit& visit,
                                 const RandomStream& stream, uint32_t first, uint32_t begin,
                                 uint32_t end, double share, Flight& flight) const {
  const SphericalTriangle& pyramid = densities_->hemisphere().pyramid(p);
  const bool weighted = options_.pyramids.sampling == PyramidSampling::kSolidAngle;
  const int64_t rays = std::max<int64_t>(1, std::llround(share));
  for (uint32_t ray = begin; ray < end;) {
    const uint32_t until = ray + std::min(flight.Room(), end - ray);
    const int slot = flight.batch().size;
    if (weighted) {
      AppendSolidAngleRays(frame, pyramid, stream, ray, until, flight.batch(), flight.cosine());
    } else {
      AppendProjectedAngleRays(frame, pyramid, stream, ray, until, flight.batch());
    }
    for (int c = 0; c < 3; ++c) {
      const double phi = static_cast<double>(visit.quanta[c]);
      // Flux of one ray of pyramid p (JPS00, 3.2):  phi_ray = Phi_i cos(theta) Omega_p / (pi r_ip)
      const double per_cosine = phi * pyramid.solid_angle() / (std::numbers::pi * share);
      // With directions ~ cos theta every ray of p carries the same:  phi_ray = Phi_i f_p / r_ip
      const double flux = phi * pyramid.flux_fraction() * static_cast<double>(rays) / share;
      const Deal deal(std::llround(flux), rays);
      for (uint32_t k = ray; k < until; ++k) {
        const int s = slot + static_cast<int>(k - ray);
        flight.SetFlux(
            s, c, weighted ? std::llround(per_cosine * flight.cosine()[s]) : deal.Of(k - first));
      }
    }
    ray = until;
  }
}

}  // namespace

std::string UnitVersion() {
  return std::string(kCodeVersion) + ";" + TracerPins() + ";glibc-" + gnu_get_libc_version();
}

absl::StatusOr<std::shared_ptr<const Shooter>> Shooter::Create(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
  if (absl::Status status = options.Validate(); !status.ok()) return status;
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  return std::shared_ptr<const Shooter>(
      std::make_shared<EmbreeShooter>(std::move(patches), options, *std::move(scene)));
}

}  // namespace lambert
