#include "server/work/work_table.h"

#include <algorithm>
#include <set>
#include <utility>

#include "radiosity/core/error.h"
#include "server/work/refusals.h"

namespace lambert::server {
namespace {

constexpr int kMaxSlots = 4096;
constexpr size_t kMaxWorkerIdLength = 128;

absl::Status SessionNotFound(const std::string& session) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"SESSION_NOT_FOUND", session, "there is no such session", "open a new one"});
}

absl::Status SequenceStale(const SyncRequest& request, int64_t newest) {
  return MakeError(absl::StatusCode::kAborted, {"SEQUENCE_STALE", request.session,
                                                "sequence " + std::to_string(request.sequence) +
                                                    " came after " + std::to_string(newest),
                                                "go on with the newest"});
}

absl::Status SyncReplaced(const SyncRequest& request) {
  return MakeError(absl::StatusCode::kAborted,
                   {"SYNC_REPLACED", request.session, "a newer call came", "wait for that one"});
}

absl::Status CheckWorker(const std::string& worker_id, int slots) {
  if (worker_id.empty() || worker_id.size() > kMaxWorkerIdLength) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "worker_id", "is empty or longer than 128 characters",
                      "give the worker another name"});
  }
  if (std::any_of(worker_id.begin(), worker_id.end(),
                  [](unsigned char c) { return c <= ' ' || c > '~'; })) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "worker_id",
                      "has a character that is no ASCII letter, digit "
                      "or sign",
                      "give the worker another name"});
  }
  if (slots < 1 || slots > kMaxSlots) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "slot_count", "is " + std::to_string(slots),
                      "use 1 to " + std::to_string(kMaxSlots)});
  }
  return absl::OkStatus();
}

}  // namespace

WorkTable::WorkTable(const WorkOptions& options, std::string unit_version, int64_t epoch,
                     Clock clock)
    : options_(options),
      unit_version_(std::move(unit_version)),
      clock_(std::move(clock)),
      shards_(options, unit_version_, epoch, clock_),
      next_step_(epoch),
      next_name_(epoch) {}

absl::StatusOr<std::string> WorkTable::OpenSession(const std::string& worker_id, int slots,
                                                   const std::string& unit_version) {
  if (absl::Status status = CheckWorker(worker_id, slots); !status.ok()) return status;
  if (unit_version != unit_version_) {
    return VersionUnsupported("worker " + worker_id, unit_version, unit_version_);
  }
  Calls calls;
  std::string name;
  {
    absl::MutexLock lock(&mutex_);
    if (shutting_down_) return ShuttingDown();
    std::string old;
    for (const auto& [session_name, session] : state_.sessions) {
      if (session.worker_id == worker_id) old = session_name;
    }
    if (!old.empty()) EndSession(old, true, "the worker started again", calls);
    name = "workerSessions/" + std::to_string(next_name_++);
    AddSession(state_, name, worker_id, slots, options_);
    state_.sessions.at(name).last_seen = clock_();
    exchanges_[name];
    Note("session opened, " + std::to_string(slots) + " slots", {.worker = worker_id});
    Dispatch(calls);
  }
  MakeCalls(calls);
  return name;
}

void WorkTable::Sync(const SyncRequest& request, const void* call, SyncDone done) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    auto session = state_.sessions.find(request.session);
    auto answer = [&](absl::StatusOr<SyncReply> reply) {
      calls.push_back([done, reply = std::move(reply)] { done(reply); });
    };
    if (shutting_down_) {
      answer(ShuttingDown());
    } else if (session == state_.sessions.end()) {
      answer(SessionNotFound(request.session));
    } else if (Exchange& exchange = exchanges_[request.session];
               request.sequence < exchange.sequence) {
      answer(SequenceStale(request, exchange.sequence));
    } else if (request.sequence == exchange.sequence && exchange.answered) {
      answer(exchange.reply);
    } else {
      EndHeld(exchange, SyncReplaced(request), calls);
      if (request.sequence > exchange.sequence) ApplyReports(request);
      exchange.sequence = request.sequence;
      exchange.answered = false;
      exchange.held = std::move(done);
      exchange.held_call = call;
      exchange.answer_by = clock_() + options_.sync_interval;
      session->second.last_seen = clock_();
      SetDraining(state_, request.session, request.draining);
      SetWaiting(state_, request.session, true);
      Dispatch(calls);
      if (exchange.held != nullptr && !exchange.revoked.empty()) Answer(request.session, {}, calls);
    }
  }
  MakeCalls(calls);
}

void WorkTable::ApplyReports(const SyncRequest& request) {
  std::set<std::string> listed;
  SessionState& session = state_.sessions.at(request.session);
  Exchange& exchange = exchanges_[request.session];
  for (const LeaseReport& report : request.reports) {
    auto lease = state_.leases.find(report.lease);
    const bool is_held = lease != state_.leases.end() && lease->second.session == request.session;
    if (!is_held) {
      exchange.revoked.push_back(report.lease);
    } else if (report.failed) {
      FailLease(report.lease, report.error_message);
    } else {
      listed.insert(report.lease);
    }
  }
  const std::set<std::string> held = session.leases;
  for (const std::string& lease : held) {
    if (listed.count(lease) == 0) RemoveLease(state_, lease, /*failed=*/false);
  }
}

void WorkTable::CancelSync(const std::string& session, const void* call) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    auto exchange = exchanges_.find(session);
    if (exchange != exchanges_.end() && exchange->second.held != nullptr &&
        exchange->second.held_call == call) {
      EndHeld(exchange->second, absl::CancelledError("the caller has gone"), calls);
      SetWaiting(state_, session, false);
    }
  }
  MakeCalls(calls);
}

void WorkTable::CloseSession(const std::string& session) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    EndSession(session, /*failed=*/false, "", calls);
    Dispatch(calls);
  }
  MakeCalls(calls);
}

void WorkTable::EndSession(const std::string& name, bool failed, const std::string& why,
                           Calls& calls) {
  auto session = state_.sessions.find(name);
  if (session == state_.sessions.end()) return;
  Note("session ended" + (why.empty() ? "" : ": " + why), {.worker = session->second.worker_id});
  const std::set<std::string> leases = session->second.leases;
  for (const std::string& lease : leases) {
    if (failed) {
      FailLease(lease, why);
    } else {
      RemoveLease(state_, lease, false);
    }
  }
  EndHeld(exchanges_[name], SessionNotFound(name), calls);
  exchanges_.erase(name);
  RemoveSession(state_, name);
}

void WorkTable::EndHeld(Exchange& exchange, const absl::Status& status, Calls& calls) {
  if (exchange.held == nullptr) return;
  calls.push_back([done = std::move(exchange.held), status] { done(status); });
  exchange.held = nullptr;
}

void WorkTable::FailLease(const std::string& lease, const std::string& why) {
  auto found = state_.leases.find(lease);
  if (found == state_.leases.end()) return;
  const LeaseState held = found->second;
  const std::string worker = WorkerOf(lease);
  LetRest(state_, lease, clock_(), options_);
  RemoveLease(state_, lease, /*failed=*/true);
  ++counters_.leases_failed;
  Note("lease failed: " + why,
       {"solveJobs/" + held.unit.job, held.step_number, held.unit.unit, worker});
  if (held.revoked) return;
  const UnitState& unit = state_.steps.at(held.unit.job).units[held.unit.unit];
  if (unit.attempts < options_.max_attempts) return;
  steps_.at(held.unit.job)
      ->Abort(MakeError(absl::StatusCode::kInternal,
                        {"UNIT_ATTEMPTS_EXHAUSTED",
                         "unit " + std::to_string(held.unit.unit) + " of " + held.unit.job,
                         "it failed " + std::to_string(unit.attempts) + " times, last on worker " +
                             worker + ": " + why,
                         "look at the workers' logs"}));
}

void WorkTable::Dispatch(Calls& calls) { Lend(NextLeases(state_, clock_(), options_), calls); }

void WorkTable::Lend(const std::vector<Grant>& grants, Calls& calls) {
  const TimePoint now = clock_();
  std::map<std::string, std::vector<GrantedLease>> news;
  for (const std::string& name : state_.revoked) {
    auto lease = state_.leases.find(name);
    if (lease == state_.leases.end()) continue;
    exchanges_[lease->second.session].revoked.push_back(name);
    news[lease->second.session];
  }
  state_.revoked.clear();
  for (const Grant& grant : grants) {
    const std::string lease = grant.session + "/leases/" + std::to_string(next_name_++);
    const bool is_new = grant.new_grains.count > 0;
    const int unit = is_new ? CutUnit(state_, grant.job, grant.new_grains) : grant.unit;
    ++counters_.leases_granted;
    if (!is_new) ++counters_.leases_repeated;
    AddLease(state_, {grant.job, unit}, grant.session, lease, now);
    const UnitState& lent = state_.steps.at(grant.job).units[unit];
    news[grant.session].push_back({lease, steps_.at(grant.job), unit, lent.grains});
  }
  for (auto& [session, leases] : news) {
    if (exchanges_[session].held != nullptr) Answer(session, std::move(leases), calls);
  }
}

void WorkTable::Answer(const std::string& name, std::vector<GrantedLease> leases, Calls& calls) {
  Exchange& exchange = exchanges_[name];
  exchange.reply = {exchange.sequence, std::move(leases), std::move(exchange.revoked)};
  exchange.revoked.clear();
  exchange.answered = true;
  calls.push_back([done = std::move(exchange.held), reply = exchange.reply] { done(reply); });
  exchange.held = nullptr;
  SetWaiting(state_, name, false);
}

void WorkTable::AnswerOverdue(Calls& calls) {
  const TimePoint now = clock_();
  for (auto& [name, exchange] : exchanges_) {
    if (exchange.held != nullptr && exchange.answer_by <= now) Answer(name, {}, calls);
  }
}

bool WorkTable::NeedsBlob(const std::string& sha256) const {
  absl::MutexLock lock(&mutex_);
  return std::any_of(steps_.begin(), steps_.end(), [&](const auto& published) {
    const WorkSetup& setup = published.second->setup();
    return setup.patch_set_sha256 == sha256 || setup.gather_task_sha256 == sha256;
  });
}

void WorkTable::Tick() {
  Calls calls;
  std::vector<LogLine> notes;
  {
    absl::MutexLock lock(&mutex_);
    std::vector<std::string> silent;
    for (const auto& [name, session] : state_.sessions) {
      if (clock_() - session.last_seen > options_.session_expiry) silent.push_back(name);
    }
    for (const std::string& name : silent) EndSession(name, true, "the worker fell silent", calls);
    Dispatch(calls);
    Lend(RepeatLate(state_, clock_(), options_), calls);
    AnswerOverdue(calls);
    notes.swap(notes_);
  }
  shards_.Tick();
  for (const LogLine& note : notes) options_.log(note);
  MakeCalls(calls);
}

}  // namespace lambert::server
