#include "server/doors/quotas.h"

#include <chrono>
#include <utility>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "radiosity/core/error.h"
#include "server/base/status_proto.h"

namespace lambert::server {
namespace {

constexpr char kKind[] = "quotas";

absl::Status Check(const std::string& owner, const std::string& what, double limit, double used,
                   double more, const std::string& hint) {
  if (owner.empty() || limit <= 0 || used + more <= limit) return absl::OkStatus();
  return LimitExceeded("QUOTA_EXCEEDED", owner, what, limit, used, hint);
}

}  // namespace

absl::Status LimitExceeded(const std::string& reason, const std::string& where,
                           const std::string& what, double limit, double used,
                           const std::string& hint) {
  absl::Status status = MakeError(
      absl::StatusCode::kResourceExhausted,
      {reason, where,
       absl::StrCat("the limit is ", limit, " ", what, ", of which ", used, " are used"), hint});
  AddMetadata(status, "limited", what);
  AddMetadata(status, "limit", absl::StrCat(limit));
  AddMetadata(status, "used", absl::StrCat(used));
  return status;
}

Quotas::Quotas(const QuotaOptions& options, std::function<int64_t()> day, RecordStore* records)
    : options_(options), now_(std::move(day)), records_(records) {}

// A record is `DAY RAYS MICROSECONDS`.
absl::Status Quotas::Restore() {
  absl::StatusOr<std::map<std::string, std::string>> records = records_->LoadAll(kKind);
  if (!records.ok()) return records.status();
  absl::MutexLock lock(&mutex_);
  BeginDay();
  for (const auto& [owner, text] : *records) {
    const std::vector<std::string> words = absl::StrSplit(text, ' ');
    int64_t day = 0, rays = 0, microseconds = 0;
    if (words.size() != 3 || !absl::SimpleAtoi(words[0], &day) ||
        !absl::SimpleAtoi(words[1], &rays) || !absl::SimpleAtoi(words[2], &microseconds)) {
      return DamagedRecord(kKind, owner);
    }
    if (day == day_) work_[owner] = {rays, static_cast<double>(microseconds) * 1e-6, true};
  }
  return absl::OkStatus();
}

absl::Status Quotas::Save() {
  std::vector<RecordChange> changes;
  {
    absl::MutexLock lock(&mutex_);
    for (auto& [owner, work] : work_) {
      if (owner.empty() || work.is_saved) continue;
      changes.push_back(
          {kKind, owner,
           absl::StrCat(day_, " ", work.rays, " ", static_cast<int64_t>(work.cpu_seconds * 1e6))});
      work.is_saved = true;
    }
  }
  if (changes.empty()) return absl::OkStatus();
  absl::Status saved = records_->Commit(changes);
  if (saved.ok()) return saved;
  absl::MutexLock lock(&mutex_);
  for (const RecordChange& change : changes) {
    if (const auto found = work_.find(change.id); found != work_.end()) {
      found->second.is_saved = false;
    }
  }
  return saved;
}

absl::Status Quotas::CheckJobs(const std::string& owner, int64_t used) const {
  return Check(owner, "jobs that have not ended", static_cast<double>(options_.jobs),
               static_cast<double>(used), 1, "wait for some, or cancel them");
}

absl::Status Quotas::CheckBytes(const std::string& owner, int64_t used, int64_t more) const {
  return Check(owner, "stored bytes", static_cast<double>(options_.stored_bytes),
               static_cast<double>(used), static_cast<double>(more),
               "delete jobs and scenes that are no longer needed");
}

absl::Status Quotas::CheckWork(const std::string& owner) {
  absl::MutexLock lock(&mutex_);
  BeginDay();
  const Work& work = work_[owner];
  const std::string hint = "go on tomorrow (UTC), or ask who runs the server for more";
  absl::Status rays = Check(owner, "rays a day", static_cast<double>(options_.rays_per_day),
                            static_cast<double>(work.rays), 1, hint);
  if (!rays.ok()) return rays;
  return Check(owner, "processor seconds a day", options_.cpu_seconds_per_day, work.cpu_seconds,
               1e-9, hint);
}

void Quotas::Charge(const std::string& owner, int64_t rays, double cpu_seconds) {
  absl::MutexLock lock(&mutex_);
  BeginDay();
  Work& work = work_[owner];
  work.rays += rays;
  work.cpu_seconds += cpu_seconds;
  work.is_saved = false;
}

absl::Status Quotas::BeginWatch(const std::string& owner) {
  absl::MutexLock lock(&mutex_);
  int64_t& count = watchers_[owner];
  if (options_.watchers > 0 && count >= options_.watchers) {
    return LimitExceeded("TOO_MANY_WATCHERS", owner.empty() ? "watchers" : owner, "streams at once",
                         static_cast<double>(options_.watchers), static_cast<double>(count),
                         "end some first");
  }
  ++count;
  return absl::OkStatus();
}

void Quotas::EndWatch(const std::string& owner) {
  absl::MutexLock lock(&mutex_);
  if (--watchers_[owner] == 0) watchers_.erase(owner);
}

void Quotas::BeginDay() {
  const int64_t day = now_();
  if (day == day_) return;
  day_ = day;
  work_.clear();
}

int64_t DayNow() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::hours>(since_1970).count() / 24;
}

}  // namespace lambert::server
