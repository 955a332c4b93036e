#include "worker/lease_book.h"

#include <utility>

namespace lambert::worker {

void LeaseBook::Add(v1::Lease lease) {
  absl::MutexLock lock(&mutex_);
  if (!closed_) waiting_.push_back(std::move(lease));
}

void LeaseBook::Revoke(const std::string& lease) {
  absl::MutexLock lock(&mutex_);
  std::erase_if(waiting_, [&](const v1::Lease& waiting) { return waiting.name() == lease; });
  if (taken_.count(lease) > 0) revoked_.insert(lease);
}

bool LeaseBook::IsWanted(const std::string& lease) const {
  absl::MutexLock lock(&mutex_);
  return taken_.count(lease) > 0 && revoked_.count(lease) == 0;
}

std::optional<v1::Lease> LeaseBook::Take() {
  absl::MutexLock lock(&mutex_);
  auto ready = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return closed_ || !waiting_.empty(); };
  mutex_.Await(absl::Condition(&ready));
  if (closed_) return std::nullopt;
  v1::Lease lease = std::move(waiting_.front());
  waiting_.pop_front();
  v1::LeaseReport& report = taken_[lease.name()];
  report.set_lease(lease.name());
  report.set_state(v1::LeaseReport::STATE_ACTIVE);
  ++running_;
  return lease;
}

void LeaseBook::Remove(const std::string& lease) {
  absl::MutexLock lock(&mutex_);
  taken_.erase(lease);
  revoked_.erase(lease);
  --running_;
}

void LeaseBook::Fail(const std::string& lease, const std::string& message) {
  absl::MutexLock lock(&mutex_);
  --running_;
  revoked_.erase(lease);
  auto report = taken_.find(lease);
  if (report == taken_.end()) return;
  report->second.set_state(v1::LeaseReport::STATE_FAILED);
  report->second.set_error_message(message);
}

size_t LeaseBook::Unsent() const {
  absl::MutexLock lock(&mutex_);
  return waiting_.size() + static_cast<size_t>(running_);
}

std::vector<v1::LeaseReport> LeaseBook::Reports() const {
  absl::MutexLock lock(&mutex_);
  std::vector<v1::LeaseReport> reports;
  for (const auto& [name, report] : taken_) reports.push_back(report);
  for (const v1::Lease& lease : waiting_) {
    v1::LeaseReport& report = reports.emplace_back();
    report.set_lease(lease.name());
    report.set_state(v1::LeaseReport::STATE_WAITING);
  }
  return reports;
}

void LeaseBook::Confirm(const std::vector<v1::LeaseReport>& reports) {
  absl::MutexLock lock(&mutex_);
  for (const v1::LeaseReport& report : reports) {
    if (report.state() == v1::LeaseReport::STATE_FAILED) taken_.erase(report.lease());
  }
}

void LeaseBook::Forget() {
  absl::MutexLock lock(&mutex_);
  waiting_.clear();
  taken_.clear();
  revoked_.clear();
}

void LeaseBook::Close() {
  absl::MutexLock lock(&mutex_);
  closed_ = true;
  waiting_.clear();
}

void LeaseBook::WaitUntilIdle() {
  absl::MutexLock lock(&mutex_);
  auto idle = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return running_ == 0; };
  mutex_.Await(absl::Condition(&idle));
}

}  // namespace lambert::worker
