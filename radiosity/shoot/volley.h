// Rays of patches, made eight at a time whatever visits they are of: a group costs the same however
// few of its rays are used.
#pragma once

#include <algorithm>
#include <iterator>

#include "radiosity/shoot/cell_sampler.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/ray_numbers.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// Puts rays into a flight, in the order in which they are asked for; the flight lands whenever it
// is full: it has room whenever a ray is asked for. The last rays may wait for others until Finish.
// One thread at a time.
class Volley {
 public:
  // `stream` is that of the unit, of any emitter. `sampler` may be null: no rays through cells.
  // All must outlive the volley.
  Volley(const Emitters& emitters, const CellSampler* sampler, const RandomStream& stream,
         Sequence sequence, Flight& flight)
      : emitters_(emitters),
        sampler_(sampler),
        stream_(stream),
        sequence_(sequence),
        flight_(flight) {
    std::fill(std::begin(framed_), std::end(framed_), static_cast<uint32_t>(kNoPatch));
  }

  // The rays of a visit, by the cosine law.
  void ShootCosine(const Visit& visit);
  // One ray of a patch through a cell, which is `pyramid` (CellSampler::Pyramid). `flux`: r, g, b
  // and the ray (Flight::SetFlux).
  void ShootThrough(int32_t cell, const SphericalTriangle* pyramid, PatchIndex emitter,
                    uint32_t ray, Long4 flux) {
    SetKind(/*cosine=*/false);
    groups_[waiting_ / 8].cells[waiting_ % 8] = cell;
    groups_[waiting_ / 8].pyramids[waiting_ % 8] = pyramid;
    flight_.SetSeer(Slot(), emitter, cell);
    Wait(emitter, ray, flux);
  }
  // Makes the rays that wait.
  void Finish();

 private:
  // Groups wait for each other too: one after the other they overlap in the processor.
  static constexpr int kGroups = 8;

  int Slot() const { return flight_.batch().size + waiting_; }
  void SetKind(bool cosine) {
    if (cosine_ == cosine) return;
    Finish();
    cosine_ = cosine;
  }
  void Wait(PatchIndex emitter, uint32_t ray, Long4 flux) {
    emitters_.Prefetch(emitter);
    flight_.SetFlux(Slot(), flux, ray);
    groups_[waiting_ / 8].names.emitter[waiting_ % 8] = static_cast<uint32_t>(emitter);
    groups_[waiting_ / 8].names.ray[waiting_ % 8] = ray;
    ++waiting_;
    if (waiting_ == 8 * kGroups || Slot() == RayBatch::kCapacity) Finish();
  }
  void Make(CellRays8& rays, int count);
  uint32_t ShootGroups(const Visit& visit, const RayDeal& deal, uint32_t ray);

  const Emitters& emitters_;
  const CellSampler* const sampler_;
  const RandomStream stream_;
  const Sequence sequence_;
  Flight& flight_;
  CellRays8 groups_[kGroups];  // that wait; their flux is in the slots after the batch's last ray
  int waiting_ = 0;
  bool cosine_ = true;  // and have no cells
  EmitterFrame8 frames_;
  uint32_t framed_[8];  // the patches that they are of
};

}  // namespace lambert
