// Who holds which unit: plain data, read by the policy (next_leases.h), changed by WorkTable only.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "radiosity/core/log.h"
#include "radiosity/patch/patch_set.h"
#include "server/base/clock.h"

namespace lambert::server {

struct WorkOptions {
  Duration sync_interval = std::chrono::seconds(2);  // longest hold of a worker's sync, > 0
  // Silence that ends a session, > sync_interval.
  Duration session_expiry = std::chrono::seconds(10);
  Duration straggler_floor = std::chrono::milliseconds(100);  // no unit is late before that
  Duration straggler_unknown =
      std::chrono::seconds(1);  // ... nor before that, its job's pace unknown
  double straggler_factor = 2;  // a unit is late after this many times its expected time, >= 1
  int units_per_slot = 2;       // that a worker holds: one runs, the others lie ready, > 0
  int max_attempts = 5;         // leases of one unit that may end without a result, > 0
  // A worker on which a unit failed gets nothing for that long, twice as long after each further
  // one without a success between, and at most `longest_rest`.
  Duration first_rest = std::chrono::milliseconds(100), longest_rest = std::chrono::seconds(5);
  Log log = [](const LogLine&) {};  // of sessions that end and leases that fail
  // A range of patches that is shorter is not worth a message to a merge shard, > 0: half a MiB.
  PatchIndex least_shard_patches = 1 << 14;
  int64_t max_unit_rays = 1 << 21;  // about half a second: grains are lent together up to that, > 0

  // Sets the expiry, and a sync interval of a fifth of it that is at most 2 s.
  void SetSessionExpiry(std::chrono::duration<double> expiry) {
    session_expiry = std::chrono::duration_cast<Duration>(expiry);
    sync_interval = std::min<Duration>(session_expiry / 5, std::chrono::seconds(2));
  }
};

// What is lent: some of the work units that the solver cut, one after the other. Those are small,
// so that a dozen workers are kept busy; a few workers get many at once, and send one result for
// all. The solver's units are called grains here.
//
// A unit of a published step. A job has at most one step at a time, so the job's id names the step.
struct UnitRef {
  std::string job;
  int unit = 0;
  auto operator<=>(const UnitRef&) const = default;
};

struct LeaseState {
  UnitRef unit;
  int64_t step_number = 0;
  std::string session;
  TimePoint granted;
  bool revoked =
      false;          // nobody needs its result; it fills a slot until its worker reports or sends
  bool told = false;  // its worker was told that it is revoked
};

struct UnitState {
  int first_grain = 0, grain_count = 0;
  bool done = false;
  int attempts = 0;                 // leases that ended without a result
  std::set<std::string> failed_on;  // sessions
  int64_t rays = 0;
  std::set<std::string> leases;  // names of those that run or wait, none of them revoked
  std::string result_digest;     // once done
  std::string result_worker;     // once done: who sent it
};

struct StepState {
  int64_t number = 0;
  std::vector<int64_t> grain_rays;  // by grain
  int next_grain = 0;               // grains from here on are in no unit yet
  std::vector<UnitState> units;     // that were lent so far
  std::deque<int> open;             // units that are neither done nor leased any more, next first
  std::set<int> leased;             // units that are leased and not done
};

struct SessionState {
  std::string worker_id;
  int slots = 1;
  bool draining = false;
  bool waiting = false;          // a sync is held: leases can be granted now
  TimePoint last_seen;           // when its last sync began
  std::set<std::string> leases;  // names
  int64_t finished_units = 0;
  int failures = 0;       // since it last finished a unit
  TimePoint rests_until;  // gets nothing before

  int FreeSlots() const { return slots - static_cast<int>(leases.size()); }
};

// How fast the units of a job run: the median is deaf to a worker that was frozen for a while.
struct Pace {
  std::deque<double> recent;  // seconds a ray of the last units
  double median = 0;          // of them
};

struct WorkState {
  std::map<std::string, StepState> steps;        // by job id
  std::map<std::string, SessionState> sessions;  // by name
  std::map<std::string, LeaseState> leases;      // by name
  std::map<std::string, Pace> paces;             // by job id, where units have ended
};

// Publishes a step whose grains have these rays. Requires: the job has none.
void AddStep(WorkState& state, const std::string& job, int64_t number,
             const std::vector<int64_t>& grain_rays);

// Makes the next `grain_count` grains of a job's step a unit and returns its number. Requires: so
// many are left.
int CutUnit(WorkState& state, const std::string& job, int grain_count);

// Takes a job's step away; its leases are revoked. Does nothing where there is none.
void RemoveStep(WorkState& state, const std::string& job);

// Lends a unit to a session. Requires: both are there, the unit is not done, the name is new.
void AddLease(WorkState& state, const UnitRef& unit, const std::string& session,
              const std::string& lease, TimePoint now);

// Takes a lease away. A unit that is not done and has no lease left opens again, as the next to be
// granted; `failed` counts an attempt. Does nothing where there is no such lease.
void RemoveLease(WorkState& state, const std::string& lease, bool failed);

// Lets the session that holds a lease rest, because the lease failed there. Does nothing where
// there is no such lease.
void LetRest(WorkState& state, const std::string& lease, TimePoint now, const WorkOptions& options);

// Marks a unit done, revokes its leases and learns the job's pace. Requires: the unit is not done.
void FinishUnit(WorkState& state, const UnitRef& unit, const std::string& digest,
                const std::string& worker, double run_seconds);

}  // namespace lambert::server
