// Visits of emitters -> rays in flight, by the options' method.
#pragma once

#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Any number of threads at once, each with a flight of its own.
class Launcher {
 public:
  // `patches` and `scene`, which is theirs, must outlive the launcher. Fails where the options'
  // region is not in the scene. Requires: options.method is not kAuto.
  static absl::StatusOr<std::unique_ptr<Launcher>> Create(const PatchSet& patches,
                                                          const ShootOptions& options,
                                                          const RayScene& scene);

  // Appends the rays of all visits to `flight`, which lands whenever it is full; the last ones stay
  // in its batch. INVALID_ARGUMENT for a visit that names an emitter, rays or quanta that cannot
  // be, or a pass over 65535; rays of visits before it may have been launched.
  absl::Status Launch(const WorkUnit& unit, Flight& flight) const;

 private:
  // The rays of a visit that have directions in common: rays [first, first + count).
  struct Stage {
    uint32_t first = 0, count = 0;
    Quanta quanta{};  // that they share
  };

  Launcher(const PatchSet& patches, const ShootOptions& options, const RayScene& scene)
      : options_(options), scene_(scene), emitters_(patches, scene) {}
  class CosineRays;
  bool IsPossible(const Visit& visit) const {
    const bool seen_fits =
        visit.seen.empty() ||
        (directions_ != nullptr && visit.seen.size() == directions_->sampler().fractions().size());
    return seen_fits && visit.emitter >= 0 && visit.emitter < emitters_.size() &&
           visit.ray_begin <= visit.ray_end && visit.ray_end <= visit.ray_count &&
           (visit.quanta[0] | visit.quanta[1] | visit.quanta[2]) >= 0;
  }
  void ShootSphere(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootDivided(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootProbing(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
                  const std::vector<uint32_t>& rays_of_cell, const RayNumbers& numbers,
                  Flight& flight) const;

  const ShootOptions options_;
  const RayScene& scene_;
  const Emitters emitters_;
  std::unique_ptr<DirectionTable> directions_;  // null: no method of pyramids
};

}  // namespace lambert
