#include "bench/shoot_case.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <utility>

#include "radiosity/core/digest.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/this_thread.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Keeps the rays as they are launched, and their hits.
class RecordingFlight : public Flight {
 public:
  RecordingFlight(const RayScene& scene, Arrivals& arrivals, UnitResult& result,
                  std::vector<RayBatch>& batches)
      : Flight(scene, arrivals, result, /*watch=*/false), scene_(scene), batches_(batches) {}
  void Land() override {
    scene_.Trace(batch());
    if (batch().size > 0) batches_.push_back(batch());
    LandTraced();
  }

 private:
  const RayScene& scene_;
  std::vector<RayBatch>& batches_;
};

// Forgets the rays, unless what they hit is asked for: what is left is the sampler.
class SamplingFlight : public Flight {
 public:
  SamplingFlight(const RayScene& scene, Arrivals& arrivals, UnitResult& result,
                 const std::vector<RayBatch>& traced)
      : Flight(scene, arrivals, result, /*watch=*/false), traced_(traced) {}
  void Land() override {
    if (batch().size == 0) return;
    const PatchIndex* hit = traced_[landed_++].hit;
    if (RecordsHits()) {
      std::copy_n(hit, batch().size, batch().hit);
      LandTraced();
    }
    batch().size = 0;
  }

 private:
  const std::vector<RayBatch>& traced_;
  size_t landed_ = 0;
};

// Deposits where recorded rays hit.
class DepositingFlight : public Flight {
 public:
  using Flight::Flight;
  void Deposit(const RayBatch& traced) {
    batch().size = traced.size;
    std::memcpy(batch().hit, traced.hit, sizeof(PatchIndex) * static_cast<size_t>(traced.size));
    LandTraced();
  }
};

// Of this thread on a processor: others wait for them too.
template <typename Work>
double Nanoseconds(Work work) {
  const double start = ThreadCpuSeconds();
  work();
  return 1e9 * (ThreadCpuSeconds() - start);
}

void OrDie(const absl::Status& status) {
  if (status.ok()) return;
  std::cerr << "shoot_bench: " << status << "\n";
  std::exit(1);
}

template <typename T>
T OrDie(absl::StatusOr<T> value) {
  OrDie(value.status());
  return *std::move(value);
}

constexpr int64_t kStretch = 128;  // neighbours

WorkUnit MakeUnit(PatchIndex patches, int64_t emitters, uint32_t rays_per_visit, int64_t rays) {
  WorkUnit unit;
  unit.seed = 7;
  const int64_t visits = std::max<int64_t>(1, rays / rays_per_visit);
  emitters = std::min({emitters, visits, static_cast<int64_t>(patches)});
  // Neighbours follow each other, as in the units of a run: in stretches that lie evenly.
  const int64_t stretch = std::min(emitters, kStretch);
  for (int64_t v = 0; v < visits; ++v) {
    const int64_t k = v % emitters, stretches = (emitters + stretch - 1) / stretch;
    const int64_t begin = k / stretch * (patches - stretch) / std::max<int64_t>(1, stretches - 1);
    const auto emitter = static_cast<PatchIndex>(begin + k % stretch);
    unit.visits.push_back(
        {emitter, rays_per_visit, 0, rays_per_visit, {1000000, 900001, 800003}, {}});
  }
  return unit;
}

}  // namespace

std::unique_ptr<BenchScene> BenchScene::Make(int n) {
  auto made = std::make_unique<BenchScene>();
  made->patches = std::make_shared<const PatchSet>(PatchesOf(MakeOffice(n)));
  made->scene = OrDie(RayScene::Create(*made->patches));
  made->bare = std::make_unique<BareEmbree>(*made->patches, *made->scene);
  return made;
}

ShootCase::ShootCase(BenchScene& scene, const ShootOptions& options, uint32_t rays_per_visit,
                     int64_t rays)
    : scene_(scene),
      unit_(MakeUnit(scene.patches->size(),
                     UsesPyramids(options.method) ? kDividedEmitters : scene.patches->size(),
                     rays_per_visit, rays)),
      shooter_(OrDie(Shooter::Create(scene.patches, options))),
      launcher_(OrDie(Launcher::Create(*scene.patches, options, *scene.scene))) {
  Arrivals arrivals(scene.patches->size());
  UnitResult result;
  {
    auto flight = std::make_unique<RecordingFlight>(*scene.scene, arrivals, result, batches_);
    OrDie(launcher_->Launch(unit_, *flight));
    flight->Land();
  }
  std::vector<int64_t> hits(scene.patches->size());
  for (const RayBatch& batch : batches_) {
    rays_ += batch.size;
    for (int k = 0; k < batch.size; ++k) {
      if (batch.hit[k] >= 0) ++hits[batch.hit[k]];
    }
  }
  const UnitResult shot = OrDie(shooter_->Run(unit_));
  for (const Deposit& deposit : shot.deposits) hits[deposit.patch] -= deposit.hits;
  const bool same = std::all_of(hits.begin(), hits.end(), [](int64_t n) { return n == 0; });
  if (!same || shot.rays != static_cast<int64_t>(rays_)) {
    std::cerr << "shoot_bench: the recorded rays are not those of Shooter::Run\n";
    std::exit(1);
  }
  scene.bare->SetRays(batches_);
}

TurnTimes ShootCase::Turn() {
  TurnTimes times;
  scene_.bare->Reset();
  times.bare16 = Nanoseconds([&] { scene_.bare->Intersect16(/*robust=*/true); }) / rays_;
  times.run = Nanoseconds([&] { (void)shooter_->Run(unit_); }) / rays_;
  return times;
}

StageTimes ShootCase::Stages() {
  StageTimes times;
  Arrivals arrivals(scene_.patches->size());
  UnitResult result;
  auto sampling = std::make_unique<SamplingFlight>(*scene_.scene, arrivals, result, batches_);
  times.sample = Nanoseconds([&] { OrDie(launcher_->Launch(unit_, *sampling)); }) / rays_;
  times.trace = Nanoseconds([&] {
                  for (RayBatch& batch : batches_) scene_.scene->Trace(batch);
                }) /
                rays_;
  // The shooter's arrivals are used again and again too: the first time touches new memory.
  auto depositing =
      std::make_unique<DepositingFlight>(*scene_.scene, arrivals, result, /*watch=*/false);
  for (int time = 0; time < 2; ++time) {
    times.deposit = Nanoseconds([&] {
                      for (const RayBatch& batch : batches_) depositing->Deposit(batch);
                      result.deposits = arrivals.Take();
                    }) /
                    rays_;
  }
  scene_.bare->Reset();
  times.bare8 = Nanoseconds([&] { scene_.bare->Intersect8(/*robust=*/true); }) / rays_;
  times.fast16 = Nanoseconds([&] { scene_.bare->Intersect16(/*robust=*/false); }) / rays_;
  return times;
}

std::string ShootCase::ResultDigest() const {
  UnitResult result = OrDie(shooter_->Run(unit_));
  result.cpu_seconds = 0;
  return Sha256Hex(EncodeUnitResult(result));
}

}  // namespace lambert
