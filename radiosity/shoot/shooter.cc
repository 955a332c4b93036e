#include "radiosity/shoot/shooter.h"

#include <gnu/libc-version.h>

#include <optional>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/exact_shooter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/launcher.h"
#include "radiosity/shoot/refinement.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/shoot/walk_flight.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// Changes whenever the same unit, of shooting or of gathering (gather_units.h), would give other
// bytes, or what it is computed from travels in another format.
constexpr char kCodeVersion[] = "shoot-10,gather-1";

class EmbreeShooter : public Shooter {
 public:
  EmbreeShooter(std::shared_ptr<const PatchSet> patches, const ShootOptions& options,
                std::unique_ptr<RayScene> scene, std::unique_ptr<const SurfaceTree> tree,
                std::unique_ptr<Launcher> launcher)
      : watch_(options.method == Method::kPhsAlpha),
        walks_(options.method == Method::kWalk),
        channels_(options.parts.without.Has(Part::kColor) ? kGrayChannels : kColorChannels),
        scene_(std::move(scene)),
        tree_(std::move(tree)),
        launcher_(std::move(launcher)),
        arrivals_(patches->size(), channels_),
        rests_(tree_ != nullptr ? tree_->place_count() : 0, channels_),
        reflectance_(walks_ ? patches->reflectance : std::vector<Rgb>()),
        patches_(ReadsPatches(options) ? std::move(patches) : nullptr) {
    if (tree_ != nullptr) refinement_.emplace(*patches_, *scene_, *tree_, options.pyramids);
  }

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override;

 private:
  const bool watch_;    // what rays see is part of the result
  const bool walks_;    // light goes on from where it hits
  const int channels_;  // of its units
  std::unique_ptr<RayScene> scene_;
  const std::unique_ptr<const SurfaceTree> tree_;  // null: rays rest where they arrive
  std::unique_ptr<Launcher> launcher_;
  std::optional<const Refinement> refinement_;  // with a tree
  mutable ArrivalsPool arrivals_, rests_;
  const std::vector<Rgb> reflectance_;             // of the patches, for walks
  const std::shared_ptr<const PatchSet> patches_;  // null: the launcher reads them no more
};

absl::StatusOr<UnitResult> EmbreeShooter::Run(const WorkUnit& unit) const {
  const DenormalsFlushed flushed;
  const double start = ThreadCpuSeconds();
  if (unit.channels != channels_ || unit.walks != walks_) {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"FIELD_INVALID", "work unit", "its channels, or its walks, are not those of its job",
         "use programs of one version"});
  }
  UnitResult result;
  result.channels = channels_;
  std::unique_ptr<Arrivals> arrivals = arrivals_.Borrow();
  std::unique_ptr<Flight> flight;
  if (walks_) {
    flight = std::make_unique<WalkFlight>(*scene_, launcher_->emitters(), reflectance_, unit,
                                          *arrivals, result);
  } else {
    flight = std::make_unique<Flight>(*scene_, *arrivals, result, watch_);
  }
  std::unique_ptr<Arrivals> rests;
  if (refinement_) {
    rests = rests_.Borrow();
    flight->Refine(*refinement_, unit.rays_per_m2, *rests);
  }
  // Of a unit that fails, what has arrived is dropped with its arrivals.
  if (absl::Status status = launcher_->Launch(unit, *flight); !status.ok()) return status;
  flight->Land();
  if (!flight->status().ok()) return flight->status();
  result.deposits = arrivals->Take();
  CombineSightings(result.sightings);
  arrivals_.Return(std::move(arrivals));
  if (rests != nullptr) {
    result.rests = rests->Take();
    rests_.Return(std::move(rests));
  }
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
  if (options.method == Method::kExact) {
    return CreateExactShooter(std::move(patches), options);
  }
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  std::unique_ptr<const SurfaceTree> tree;
  if (options.method == Method::kPhsHier) tree = std::make_unique<const SurfaceTree>(*patches);
  absl::StatusOr<std::unique_ptr<Launcher>> launcher = Launcher::Create(
      *patches, options, **scene, options.pyramids.hier_densities ? tree.get() : nullptr);
  if (!launcher.ok()) return launcher.status();
  return std::make_shared<const EmbreeShooter>(std::move(patches), options, *std::move(scene),
                                               std::move(tree), *std::move(launcher));
}

}  // namespace lambert
