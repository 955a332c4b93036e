// Visits of emitters -> rays in flight, by the options' method.
#pragma once

#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/types/span.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/shoot/volley.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Any number of threads at once, each with a flight of its own.
class Launcher {
 public:
  // `scene` and `tree` are of `patches` and must outlive the launcher, the patches where
  // ReadsPatches(options). With a tree, the patches of an element share its densities where they
  // have too few rays for their own. Fails where the options' region is not in the scene. Requires:
  // options.method is not kAuto.
  static absl::StatusOr<std::unique_ptr<Launcher>> Create(const PatchSet& patches,
                                                          const ShootOptions& options,
                                                          const RayScene& scene,
                                                          const SurfaceTree* tree = nullptr);

  // Appends the rays of all visits to `flight`, which lands whenever it is full; the last ones stay
  // in its batch. INVALID_ARGUMENT for quanta under 0 or over kMaxUnitQuanta in all, a pass over
  // 65535, or a visit that names an emitter or rays that cannot be; rays of visits before it may
  // have been launched.
  absl::Status Launch(const WorkUnit& unit, Flight& flight) const;

  const Emitters& emitters() const { return emitters_; }

 private:
  // The rays of a visit that have directions in common: rays [first, first + count).
  struct Stage {
    uint32_t first = 0, count = 0;
    Quanta quanta{};       // that they share
    bool probing = false;  // all are shot; those that are not of the visit's range only look
  };

  Launcher(const PatchSet& patches, const ShootOptions& options, const RayScene& scene,
           const SurfaceTree* tree)
      : options_(options), emitters_(patches, scene, tree) {}
  class Offsets;
  bool IsPossible(const Visit& visit) const {
    const bool seen_fits =
        visit.seen.empty() ||
        (directions_ != nullptr && visit.seen.size() == directions_->sampler().fractions().size());
    return seen_fits && visit.emitter >= 0 && visit.emitter < emitters_.size() &&
           visit.ray_begin <= visit.ray_end && visit.ray_end <= visit.ray_count;
  }
  // Whose directions the rays of a visit follow (DirectionTable::PlaceFor); kNoPatch: all the same.
  PatchIndex PlaceFor(const WorkUnit& unit, const Visit& visit) const {
    if (directions_ == nullptr || emitters_.IsLight(visit.emitter)) return kNoPatch;
    return directions_->PlaceFor(visit, unit.rays_per_m2);
  }
  Stage ProbingStage(const Visit& visit) const;
  void ShootLight(const Visit& visit, RandomStream stream, Flight& flight) const;
  std::vector<CellHit> ShootProbes(const WorkUnit& unit, Offsets& offsets, Volley& volley,
                                   Flight& flight) const;
  void ShootFollowing(const Visit& visit, absl::Span<const CellHit> seen, uint32_t offset,
                      Volley& volley) const;
  void ShootDivided(const Visit& visit, PatchIndex place, uint32_t offset, Volley& volley) const;
  void ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
                  uint32_t offset, Volley& volley) const;

  const ShootOptions options_;
  const Emitters emitters_;
  std::unique_ptr<DirectionTable> directions_;  // null: no pyramids
};

}  // namespace lambert
