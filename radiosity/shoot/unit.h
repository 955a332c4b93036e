// A unit of work and its result: pure data, a pure function apart (shooter.h).
//
// Flux travels in quanta: int64 multiples of a power of two lumen that the step fixes per channel.
// Sums of integers do not depend on order, so results merge to the same bits in any order.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

using Quanta = std::array<int64_t, 3>;  // r, g, b; of gray light r, 0, 0

// Channels that travel: of gray light r stands for all three.
inline constexpr int kColorChannels = 3, kGrayChannels = 1;

inline Rgb InLumen(const Quanta& quanta, const Rgb& quantum_lm) {
  return quantum_lm * Rgb{static_cast<double>(quanta[0]), static_cast<double>(quanta[1]),
                          static_cast<double>(quanta[2])};
}

// All visits of a step shoot about 2^kMaxQuantaBits quanta a channel at most (AllocateRays). A ray
// may carry 404 times what its patch shoots: 101 where its pyramid has the least density
// (density.h), times 4 for the greatest cosine of a pyramid over its mean. So a shooter refuses
// units whose visits hold more than kMaxUnitQuanta a channel, parts of one visit that follow each
// other counted once: what they shoot might not fit into 63 bits.
inline constexpr int kMaxQuantaBits = 54;
inline constexpr int64_t kMaxUnitQuanta = std::numeric_limits<int64_t>::max() / 404;  // 1.27 * 2^54

// Rays [ray_begin, ray_end) of the `ray_count` rays that share the quanta of one emitter.
// Emitter: patch index, or patches.size() + l for light l.
struct Visit {
  PatchIndex emitter = 0;
  uint32_t ray_count = 0;
  uint32_t ray_begin = 0, ray_end = 0;
  Quanta quanta{};  // dealt over all ray_count rays: quotient, then one extra to the first
  // Patches that rays of the emitter have hit so far through each cell of its hemisphere; empty:
  // nothing is known (method phs-alpha).
  std::vector<uint32_t> seen{};
  bool operator==(const Visit&) const = default;
};

struct WorkUnit {
  uint64_t seed = 0;
  uint32_t pass = 0, step = 0;
  std::vector<Visit> visits;
  // Rays that the step shoots over the area that may shoot (method phs-hier).
  double rays_per_m2 = 0;
  int channels = kColorChannels;
  // Each ray of a visit is the first of a walk: light goes on from where it hits (method walk).
  bool walks = false;
  bool operator==(const WorkUnit&) const = default;

  int64_t RayCount() const;  // of the visits: where rays go on, those that they begin with
  // Whether work that begins with `rays` rays may come to `shot` of them.
  bool MayHaveShot(int64_t rays, int64_t shot) const { return walks ? shot >= rays : shot == rays; }
};

// What arrived at one patch, or came to rest at one place of a SurfaceTree.
struct Deposit {
  int64_t r = 0, g = 0, b = 0;  // quanta
  int64_t hits = 0;             // rays, > 0
  PatchIndex patch = 0;
  Quanta quanta() const { return {r, g, b}; }
  bool operator==(const Deposit&) const = default;
};

// That rays of an emitter hit a patch through a cell of its hemisphere (JPS00, 3.3).
struct Sighting {
  int32_t emitter = 0, cell = 0;
  PatchIndex patch = 0;
  int32_t times = 1;  // 1, 2, or kManyTimes for more
  bool operator==(const Sighting&) const = default;
};
inline constexpr int32_t kManyTimes = 3;

// Sorts by emitter, cell and patch; what stands there more than once becomes one, its times added.
void CombineSightings(std::vector<Sighting>& sightings);

// Result of one unit, or of any number of merged units.
struct UnitResult {
  // Of the patches that were hit, in order: the last rays of a pass hit few of many patches.
  std::vector<Deposit> deposits;
  // The same flux once more, at the patches and elements where it comes to rest, by place: what the
  // solution shows (method phs-hier). What a patch reflects is what arrived at it.
  std::vector<Deposit> rests;
  // In order, each once (method phs-alpha).
  std::vector<Sighting> sightings;
  Quanta shot{};     // = sum of deposits + escaped, each channel; of walks, at each bounce
  Quanta escaped{};  // left the scene
  int64_t rays = 0;
  int channels = kColorChannels;  // of the unit
  double cpu_seconds = 0;         // of the thread that ran it; not part of the canonical bytes
  bool operator==(const UnitResult&) const = default;
};

// Adds `from` to `into`. Associative and commutative (cpu_seconds but for rounding), and an empty
// result changes nothing; numbers are added modulo 2^64, so this holds for any numbers at all. Of
// results of one step of AllocateRays no sum comes near that. Requires: both are of as many
// channels, or one has no rays.
void MergeResult(const UnitResult& from, UnitResult& into);

// Gives all three channels what the first has.
void SpreadGray(UnitResult& result);

// OK if the channels are the unit's; shot = deposited + escaped in each channel, without overflow;
// what came to rest is what was deposited where the unit asks for it (rays_per_m2 > 0), and nothing
// did where it does not; the rays are those of `unit`, or not fewer where they go on, and hits +
// misses. Else DATA_LOSS (reason RESULT_INVALID) with both numbers. So a fault in one number of
// flux is noticed. What is not: flux at a wrong patch or place, hits short of all rays, sightings,
// and faults of several numbers that balance. Those show where a unit is run twice, in bytes that
// differ.
absl::Status CheckLedger(const WorkUnit& unit, const UnitResult& result);

// Canonical bytes (docs/formats.md): a unit's result has the same bytes wherever it was computed,
// so cpu_seconds travels beside them (0 after decoding). Decoding fails with DATA_LOSS and never
// crashes; limits are checked before anything is allocated. `patch_count` is what the result must
// be about.
std::string EncodeUnit(const WorkUnit& unit);
absl::StatusOr<WorkUnit> DecodeUnit(const std::string& bytes);
std::string EncodeUnitResult(const UnitResult& result);
absl::StatusOr<UnitResult> DecodeUnitResult(const std::string& bytes, PatchIndex patch_count);

}  // namespace lambert
