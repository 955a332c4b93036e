#include "server/work/shard_table.h"

#include <algorithm>
#include <utility>

#include "radiosity/core/error.h"
#include "server/work/refusals.h"
#include "server/work/result_bytes.h"

namespace lambert::server {
namespace {

// A sum is sent in less, on a link of 4 MiB a second.
constexpr std::chrono::seconds kLongestWait(30);
constexpr PatchIndex kPatchesPerSecond = 1 << 17;
constexpr size_t kMaxNameLength = 128, kMaxAddressLength = 255;

bool IsWord(const std::string& text, size_t longest) {
  return !text.empty() && text.size() <= longest &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return c > ' ' && c <= '~'; });
}

absl::Status Invalid(const std::string& field) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"FIELD_INVALID", field, "is empty, too long, or no word", "name it properly"});
}

absl::Status Replaced(const std::string& shard) {
  return MakeError(absl::StatusCode::kAborted,
                   {"SYNC_REPLACED", "merge shard " + shard, "a newer call came", "wait for it"});
}

}  // namespace

ShardTable::ShardTable(const WorkOptions& options, std::string unit_version, int64_t epoch,
                       Clock clock)
    : options_(options),
      unit_version_(std::move(unit_version)),
      clock_(std::move(clock)),
      version_(epoch) {}

absl::Status ShardTable::Check(const ShardSync& request) const {
  if (shutting_down_) return ShuttingDown();
  if (!IsWord(request.shard, kMaxNameLength)) return Invalid("shard");
  if (!IsWord(request.address, kMaxAddressLength)) return Invalid("address");
  if (request.unit_version == unit_version_) return absl::OkStatus();
  return VersionUnsupported("merge shard " + request.address, request.unit_version, unit_version_);
}

void ShardTable::Sync(const ShardSync& request, const void* call, ShardSyncDone done) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    if (absl::Status status = Check(request); !status.ok()) {
      calls.push_back([done, status] { done(status); });
    } else {
      std::string before;
      for (const auto& [name, shard] : shards_) {
        if (shard.address == request.address && name != request.shard) before = name;
      }
      if (!before.empty()) Lose(before, "another took its address", calls);
      const bool is_new = shards_.count(request.shard) == 0;
      Shard& shard = shards_[request.shard];
      if (is_new) Note("merge shard " + request.shard + " at " + request.address, calls);
      EndHeld(shard, Replaced(request.shard), calls);
      shard.address = request.address;
      shard.draining = request.draining;
      shard.last_seen = clock_();
      shard.answer_by = clock_() + options_.sync_interval;
      shard.seen_version = request.seen_version;
      shard.held = std::move(done);
      shard.held_call = call;
      AnswerHeld(calls);
    }
  }
  MakeCalls(calls);
}

void ShardTable::CancelSync(const std::string& name, const void* call) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    auto shard = shards_.find(name);
    if (shard != shards_.end() && shard->second.held_call == call) {
      EndHeld(shard->second, absl::CancelledError("the caller has gone"), calls);
    }
  }
  MakeCalls(calls);
}

void ShardTable::EndHeld(Shard& shard, absl::StatusOr<ShardOrders> reply, Calls& calls) {
  if (shard.held == nullptr) return;
  calls.push_back([done = std::move(shard.held), reply = std::move(reply)] { done(reply); });
  shard.held = nullptr;
  shard.held_call = nullptr;
}

ShardOrders ShardTable::OrdersOf(const std::string& shard) const {
  ShardOrders orders{version_, {}};
  for (const auto& [number, awaited] : steps_) {
    for (const ShardRange& range : awaited.step->shards()) {
      if (range.shard == shard) orders.orders.push_back({awaited.step, range.first, range.end});
    }
  }
  return orders;
}

void ShardTable::AnswerHeld(Calls& calls) {
  const TimePoint now = clock_();
  for (auto& [name, shard] : shards_) {
    if (shard.held == nullptr) continue;
    if (shard.seen_version == version_ && now < shard.answer_by) continue;
    EndHeld(shard, OrdersOf(name), calls);
  }
}

void ShardTable::Note(const std::string& line, Calls& calls) const {
  calls.push_back([this, line] { options_.log(line); });
}

std::vector<ShardRange> ShardTable::Divide(PatchIndex patch_count) const {
  absl::MutexLock lock(&mutex_);
  std::vector<ShardRange> ranges;
  const auto most = static_cast<size_t>(patch_count / std::max(options_.least_shard_patches, 1));
  for (const auto& [name, shard] : shards_) {
    if (!shard.draining && ranges.size() < most) ranges.push_back({name, shard.address});
  }
  const auto count = static_cast<int64_t>(ranges.size());
  for (int64_t i = 0; i < count; ++i) {
    ranges[i].first = static_cast<PatchIndex>(patch_count * i / count);
    ranges[i].end = static_cast<PatchIndex>(patch_count * (i + 1) / count);
  }
  return ranges;
}

void ShardTable::Add(const std::shared_ptr<PublishedStep>& step) {
  if (step->shards().empty()) return;
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    steps_[step->number()].step = step;
    ++version_;
    for (const ShardRange& range : step->shards()) {
      if (shards_.count(range.shard) > 0) continue;
      step->Abort(PublishedStep::ShardFailed(range.address, "it has gone"));
    }
    AnswerHeld(calls);
  }
  MakeCalls(calls);
}

void ShardTable::Remove(const std::shared_ptr<PublishedStep>& step) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    if (steps_.erase(step->number()) == 0) return;
    ++version_;
    AnswerHeld(calls);
  }
  MakeCalls(calls);
}

absl::StatusOr<bool> ShardTable::TakeRange(const std::string& shard, int64_t step_number,
                                           const std::string& bytes) {
  std::shared_ptr<PublishedStep> step;
  {
    absl::MutexLock lock(&mutex_);
    auto found = steps_.find(step_number);
    if (found == steps_.end() || shards_.count(shard) == 0) return false;
    step = found->second.step;
  }
  const absl::Status taken = step->TakeRange(shard, bytes);
  if (absl::IsNotFound(taken)) return false;
  if (!taken.ok()) return taken;
  return true;
}

int64_t ShardTable::MaxRangeBytes(int64_t step_number) const {
  absl::MutexLock lock(&mutex_);
  auto found = steps_.find(step_number);
  if (found == steps_.end()) return 0;
  const PublishedStep& step = *found->second.step;
  return MaxResultBytes(step.setup().patch_count, step.rays(), step.setup().has_sightings);
}

void ShardTable::Lose(const std::string& name, const std::string& why, Calls& calls) {
  auto shard = shards_.find(name);
  const std::string address = shard->second.address;
  EndHeld(shard->second, Replaced(name), calls);
  shards_.erase(shard);
  ++version_;
  Note("merge shard " + name + " at " + address + " is lost: " + why, calls);
  for (const auto& [number, awaited] : steps_) {
    if (awaited.step->WaitsFor(name)) {
      awaited.step->Abort(PublishedStep::ShardFailed(address, why));
    }
  }
}

void ShardTable::GiveUpLate() {
  for (auto& [number, awaited] : steps_) {
    if (!awaited.step->WaitsForShards()) continue;
    awaited.waits_since = std::min(awaited.waits_since, clock_());
    const WorkSetup& setup = awaited.step->setup();
    const std::chrono::seconds most =
        kLongestWait + std::chrono::seconds(setup.patch_count / kPatchesPerSecond);
    if (clock_() - awaited.waits_since < most) continue;
    for (const ShardRange& range : awaited.step->shards()) {
      if (!awaited.step->WaitsFor(range.shard)) continue;
      awaited.step->Abort(PublishedStep::ShardFailed(range.address, "its sum does not come"));
    }
  }
}

void ShardTable::Tick() {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    std::vector<std::string> silent;
    for (const auto& [name, shard] : shards_) {
      if (clock_() - shard.last_seen > options_.session_expiry) silent.push_back(name);
    }
    for (const std::string& name : silent) Lose(name, "it fell silent", calls);
    GiveUpLate();
    AnswerHeld(calls);
  }
  MakeCalls(calls);
}

void ShardTable::Shutdown() {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    shutting_down_ = true;
    for (auto& [name, shard] : shards_) EndHeld(shard, ShuttingDown(), calls);
  }
  MakeCalls(calls);
}

int ShardTable::shard_count() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(shards_.size());
}

}  // namespace lambert::server
