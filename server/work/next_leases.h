// The policy: which waiting worker gets which unit.
#pragma once

#include <string>
#include <vector>

#include "server/work/work_state.h"

namespace lambert::server {

struct Grant {
  std::string session;
  std::string job;
  int unit = -1;               // of the job's step; -1: a new one
  GrainRange new_grains = {};  // of a new unit
  bool operator==(const Grant&) const = default;
};

// Pure: equal arguments give equal grants. Only sessions that wait, do not drain and do not rest
// get any.
//  1. Open work fills free slots, the emptiest worker first, jobs in turn. A new unit takes half of
//     its share of the grains that are left, so units get smaller towards the end of a step and all
//     workers end together (guided self-scheduling); it begins where its worker is at home
//     (HomeOf), or beyond, where that was taken: nobody waits for it. A unit that failed on a
//     worker goes to another one, as long as there is any on which it did not; and that worker gets
//     one unit at a time until one succeeds. A step of few rays stays with the few workers that it
//     is worth (MostSessions).
//  2. What is still open is granted ahead, up to `most_leases` of a session, so that the next unit
//     lies there when one ends; but never a unit for which somebody else has a free slot.
// Looks at who might get something, not at every session.
std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options);

// Pure, too: slots that are still free repeat units that are late (their worker may be frozen), the
// oldest first, never one that the same worker holds. Looks at every lease of every step. Requires:
// what NextLeases gives was granted.
std::vector<Grant> RepeatLate(const WorkState& state, TimePoint now, const WorkOptions& options);

// How many sessions a step is worth, 1 or more. Each adds up all patches and sends those sums, so
// that P sessions of s slots take R t / (P s) to trace R rays and P N b to send sums of N patches:
// least where P = sqrt(R t / (s N b)); with several who merge, b is as many times smaller.
int MostSessions(const StepState& step, const Roster& roster, const WorkOptions& options);

// How long a lease of `rays` rays may take before its unit counts as late.
Duration LateAfter(const WorkState& state, const std::string& job, int64_t rays,
                   const WorkOptions& options);

}  // namespace lambert::server
