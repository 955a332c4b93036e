// The policy: which waiting worker gets which unit.
#pragma once

#include <string>
#include <vector>

#include "server/work/work_state.h"

namespace lambert::server {

struct Grant {
  std::string session;
  UnitRef unit;
  bool operator==(const Grant&) const = default;
};

// Pure: equal arguments give equal grants. Only sessions that wait and do not drain get any.
//  1. Open units fill free slots, the emptiest worker first, jobs in turn.
//  2. What is still open is granted ahead, one unit a worker beyond its slots, so that the next unit
//     lies there when one ends; but never a unit for which somebody else has a free slot.
//  3. With nothing open, free slots repeat units that are late (their worker may be frozen), the
//     oldest first, never one that the same worker holds.
std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options);

// How long a lease of `rays` rays may take before its unit counts as late.
Duration LateAfter(const WorkState& state, const std::string& job, int64_t rays,
                   const WorkOptions& options);

}  // namespace lambert::server
