#include "server/doors/quotas.h"

#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "server/base/status_proto.h"

namespace lambert::server {
namespace {

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

Quotas::Quotas(const QuotaOptions& options, std::function<int64_t()> day)
    : options_(options), now_(std::move(day)) {}

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
  work_[owner].rays += rays;
  work_[owner].cpu_seconds += cpu_seconds;
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
