// The policy: which waiting worker gets which unit.
#pragma once

#include <string>
#include <vector>

#include "server/work/work_state.h"

namespace lambert::server {

struct Grant {
  std::string session;
  std::string job;
  int unit = -1;       // of the job's step; -1: a new one
  int new_grains = 0;  // of a new unit
  bool operator==(const Grant&) const = default;
};

// Pure: equal arguments give equal grants. Only sessions that wait, do not drain and do not rest
// get any.
//  1. Open work fills free slots, the emptiest worker first, jobs in turn. A new unit takes half of
//     its share of the grains that are left, so units get smaller towards the end of a step and all
//     workers end together (guided self-scheduling). A unit that failed on a worker goes to another
//     one, as long as there is any on which it did not; and that worker gets one unit at a time
//     until one succeeds.
//  2. What is still open is granted ahead, up to `units_per_slot`, so that the next unit lies there
//     when one ends; but never a unit for which somebody else has a free slot.
//  3. With nothing open for them, free slots repeat units that are late (their worker may be
//     frozen), the oldest first, never one that the same worker holds.
std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options);

// How long a lease of `rays` rays may take before its unit counts as late.
Duration LateAfter(const WorkState& state, const std::string& job, int64_t rays,
                   const WorkOptions& options);

}  // namespace lambert::server
