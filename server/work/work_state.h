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
#include "server/work/grain_runs.h"

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
  // Grains are lent together up to so many rays, about half a second, or one a patch, > 0.
  int64_t max_unit_rays = 1 << 21;
  // Rays that a slot traces while a patch of all that a worker sends in a step, about three sums of
  // 32 bytes, crosses the link of who merges, > 0: .17 us a ray, 10 Gb/s. Says how many workers a
  // step is worth (MostSessions, next_leases.h).
  double rays_per_sum = 0.45;

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
      false;  // nobody needs its result; it fills a slot until its worker reports or sends
};

struct UnitState {
  GrainRange grains;
  bool done = false;
  int attempts = 0;                 // leases that ended without a result
  std::set<std::string> failed_on;  // sessions
  int64_t rays = 0;
  std::set<std::string> leases;  // names of those that run or wait, none of them revoked
  std::string result_digest;     // once done
  std::string result_worker;     // once done: who sent it
};

// What one who merges a step has to take of each worker.
struct SumSize {
  int64_t patches = 0;  // that a result adds up; 0: results hold no sums
  int mergers = 1;      // who share them
};

struct StepState {
  int64_t number = 0;
  std::vector<int64_t> grain_rays;  // by grain
  int64_t rays = 0;                 // of all
  SumSize sums;
  GrainRuns uncut;               // grains that are in no unit yet
  std::vector<UnitState> units;  // that were lent so far
  std::deque<int> open;          // units that are neither done nor leased any more, next first
  std::set<int> leased;          // units that are leased and not done
  std::map<std::string, int> holders;  // sessions that hold leases of these, and how many
};

struct SessionState {
  std::string worker_id;
  int slots = 1;
  int most_leases = 2;  // that it may hold, > 0
  size_t seat = 0;      // in WorkState::seats
  bool draining = false;
  bool waiting = false;          // a sync is held: leases can be granted now
  TimePoint last_seen;           // when its last sync began
  std::set<std::string> leases;  // names
  int64_t finished_units = 0;
  int failures = 0;       // since it last finished a unit
  TimePoint rests_until;  // gets nothing before

  int FreeSlots() const { return slots - static_cast<int>(leases.size()); }
};

// The median of the last few: deaf to a worker that was frozen for a while.
struct RecentMedian {
  std::deque<double> recent;
  double median = 0;  // of them
};

// How fast the units of a job come back.
struct Pace {
  RecentMedian seconds_per_ray;  // that units ran
  RecentMedian wait_s;           // what their leases took beyond that: in queues, and on links
};

// What the policy asks of all sessions, so that it need not look at each.
struct Roster {
  int sessions = 0, slots = 0;   // of those that do not drain
  int free_elsewhere = 0;        // free slots of those that neither wait nor drain
  std::set<std::string> takers;  // that wait, do not drain and may hold more leases
};

struct WorkState {
  std::map<std::string, StepState> steps;        // by job id
  std::map<std::string, SessionState> sessions;  // by name
  std::map<std::string, LeaseState> leases;      // by name
  std::map<std::string, Pace> paces;             // by job id, where units have ended
  Roster roster;                                 // of the sessions
  std::vector<std::string> seats;                // all sessions, in an order that changes little
  std::vector<std::string> revoked;              // leases whose workers were not told of it yet
};

// A new session. Requires: its name is new.
void AddSession(WorkState& state, const std::string& name, const std::string& worker_id, int slots,
                const WorkOptions& options);
// Requires: the session is there, and holds no leases.
void RemoveSession(WorkState& state, const std::string& name);
// Requires: the session is there.
void SetWaiting(WorkState& state, const std::string& name, bool waiting);
void SetDraining(WorkState& state, const std::string& name, bool draining);

// Publishes a step whose grains have these rays. Requires: the job has none.
void AddStep(WorkState& state, const std::string& job, int64_t number,
             const std::vector<int64_t>& grain_rays, const SumSize& sums = {});

// Where among a step's grains a session begins: each has a stretch of its own, of equal length, and
// the same one in every step while nobody comes or goes. Grains follow the order of the patches, so
// it mostly shoots from patches that it knows: densities are kept where they were computed.
// Requires: the session is there.
int HomeOf(const WorkState& state, const StepState& step, const std::string& session);

// Makes grains of a job's step a unit and returns its number. Requires: they are in none.
int CutUnit(WorkState& state, const std::string& job, const GrainRange& grains);

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

// Marks a unit done, revokes its leases and learns the job's pace: `lease_seconds` are those from
// the grant to the result, of which it ran `run_seconds`. Requires: the unit is not done.
void FinishUnit(WorkState& state, const UnitRef& unit, const std::string& digest,
                const std::string& worker, double run_seconds, double lease_seconds);

}  // namespace lambert::server
