#include "radiosity/shoot/shooter.h"

#include <gnu/libc-version.h>

#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/exact_shooter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/launcher.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// Changes whenever the same unit would give other bytes.
constexpr char kCodeVersion[] = "shoot-5";

class EmbreeShooter : public Shooter {
 public:
  EmbreeShooter(std::shared_ptr<const PatchSet> patches, const ShootOptions& options,
                std::unique_ptr<RayScene> scene, std::unique_ptr<Launcher> launcher)
      : patches_(std::move(patches)),
        watch_(options.method == Method::kPhsAlpha),
        scene_(std::move(scene)),
        launcher_(std::move(launcher)),
        arrivals_(patches_->size()) {}

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override;

 private:
  std::shared_ptr<const PatchSet> patches_;
  const bool watch_;  // what rays see is part of the result
  std::unique_ptr<RayScene> scene_;
  std::unique_ptr<Launcher> launcher_;
  mutable ArrivalsPool arrivals_;
};

absl::StatusOr<UnitResult> EmbreeShooter::Run(const WorkUnit& unit) const {
  const DenormalsFlushed flushed;
  const double start = ThreadCpuSeconds();
  UnitResult result;
  std::unique_ptr<Arrivals> arrivals = arrivals_.Borrow();
  auto flight = std::make_unique<Flight>(*scene_, *arrivals, result, watch_);
  // Of a unit that fails, what has arrived is dropped with its arrivals.
  if (absl::Status status = launcher_->Launch(unit, *flight); !status.ok()) return status;
  flight->Land();
  result.deposits = arrivals->Take();
  CombineSightings(result.sightings);
  arrivals_.Return(std::move(arrivals));
  result.cpu_seconds = ThreadCpuSeconds() - start;
  return result;
}

}  // namespace

std::string UnitVersion() {
  return std::string(kCodeVersion) + ";" + TracerPins() + ";glibc-" + gnu_get_libc_version();
}

absl::StatusOr<std::shared_ptr<const Shooter>> Shooter::Create(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
  if (absl::Status status = ValidateFor(*patches, options); !status.ok()) return status;
  if (options.method == Method::kExact) return CreateExactShooter(std::move(patches));
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  absl::StatusOr<std::unique_ptr<Launcher>> launcher = Launcher::Create(*patches, options, **scene);
  if (!launcher.ok()) return launcher.status();
  return std::make_shared<const EmbreeShooter>(std::move(patches), options, *std::move(scene),
                                               *std::move(launcher));
}

}  // namespace lambert
