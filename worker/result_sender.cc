#include "worker/result_sender.h"

#include "net/backoff.h"
#include "net/calls.h"
#include "radiosity/core/digest.h"
#include "radiosity/shoot/result_range.h"

namespace lambert::worker {
namespace {

// The book may change while nothing else does: a lease that waits is revoked.
constexpr absl::Duration kLook = absl::Milliseconds(10);

v1::SubmitUnitResultRequest HeaderOf(const FinishedUnit& unit) {
  v1::SubmitUnitResultRequest header;
  header.set_lease(unit.lease.name());
  *header.mutable_unit_key() = unit.lease.unit_key();
  header.set_run_seconds(unit.run_seconds);
  return header;
}

}  // namespace

ResultSender::ResultSender(ServerLink* link, LeaseBook* book, const WorkerOptions& options,
                           std::function<void()> on_failed)
    : link_(link),
      book_(book),
      options_(options),
      on_failed_(std::move(on_failed)),
      parts_(book, options, &stop_retrying_),
      thread_([this] { Work(); }) {}

ResultSender::~ResultSender() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void ResultSender::Send(FinishedUnit unit) {
  absl::MutexLock lock(&mutex_);
  auto has_room = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return items_.size() + sending_ <= static_cast<size_t>(options_.slots);
  };
  mutex_.Await(absl::Condition(&has_room));
  items_.push_back(std::move(unit));
}

bool ResultSender::IsTimeToSend() const {
  return stopping_ || items_.size() >= static_cast<size_t>(options_.slots) ||
         items_.size() >= book_->Unsent();
}

void ResultSender::StopRetrying() { stop_retrying_.Notify(); }

std::vector<FinishedUnit> ResultSender::TakeBatch() {
  std::vector<FinishedUnit> batch;
  const v1::UnitKey first = items_.front().lease.unit_key();
  while (!items_.empty()) {
    const v1::UnitKey& next = items_.front().lease.unit_key();
    if (next.solve_job() != first.solve_job() || next.step_number() != first.step_number()) break;
    batch.push_back(std::move(items_.front()));
    items_.pop_front();
  }
  return batch;
}

void ResultSender::Work() {
  while (true) {
    std::vector<FinishedUnit> batch;
    {
      absl::MutexLock lock(&mutex_);
      auto ready = [this]()
                       ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return stopping_ || !items_.empty(); };
      mutex_.Await(absl::Condition(&ready));
      if (items_.empty()) return;
      auto is_time = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return IsTimeToSend(); };
      while (!mutex_.AwaitWithTimeout(absl::Condition(&is_time), kLook)) {
      }
      batch = TakeBatch();
      sending_ = batch.size();
    }
    const absl::Status sent = SendAll(batch);
    for (const FinishedUnit& unit : batch) {
      if (sent.ok()) {
        book_->Remove(unit.lease.name());
      } else {
        book_->Fail(unit.lease.name(), std::string(sent.message()));
      }
    }
    if (!sent.ok()) on_failed_();
    absl::MutexLock lock(&mutex_);
    sending_ = 0;
  }
}

absl::Status ResultSender::SendAll(const std::vector<FinishedUnit>& units) {
  const bool is_sharded = units[0].lease.merge_ranges_size() > 0;
  if (units.size() == 1 && !is_sharded) {
    SendOne(units[0]);
    return absl::OkStatus();
  }
  UnitResult sum;
  for (const FinishedUnit& unit : units) MergeResult(unit.result, sum);
  if (is_sharded) {
    const absl::StatusOr<bool> sent = parts_.Send(units, sum);
    if (!sent.ok() || !*sent) return sent.status();
    sum = LedgerOf(sum);
  }
  SendSum(units, sum);
  return absl::OkStatus();
}

void ResultSender::SendSum(const std::vector<FinishedUnit>& units, const UnitResult& sum) {
  v1::SubmitUnitResultRequest header = HeaderOf(units[0]);
  for (const FinishedUnit& unit : units) {
    v1::CombinedUnit* combined = header.add_combined_units();
    combined->set_lease(unit.lease.name());
    combined->set_unit_index(unit.lease.unit_key().unit_index());
    combined->set_result_sha256(Sha256Hex(EncodeUnitResult(unit.result)));
    combined->set_run_seconds(unit.run_seconds);
  }
  const absl::StatusOr<Outcome> outcome = Offer(std::move(header), sum);
  if (!outcome.ok()) {
    for (const FinishedUnit& unit : units) LogRefusal(outcome.status(), unit);
  } else if (*outcome == v1::SubmitUnitResultResponse::OUTCOME_SPLIT) {
    for (const FinishedUnit& unit : units) SendOne(unit);
  }
}

void ResultSender::SendOne(const FinishedUnit& unit) {
  if (unit.lease.merge_ranges_size() > 0) return SendSum({unit}, LedgerOf(unit.result));
  const absl::StatusOr<Outcome> outcome = Offer(HeaderOf(unit), unit.result);
  if (!outcome.ok()) LogRefusal(outcome.status(), unit);
}

void ResultSender::LogRefusal(const absl::Status& status, const FinishedUnit& unit) const {
  options_.log(
      {"the result was not taken: " + std::string(status.message()), SubjectOf(unit.lease)});
}

absl::StatusOr<ResultSender::Outcome> ResultSender::Offer(v1::SubmitUnitResultRequest header,
                                                          const UnitResult& result) {
  const std::string bytes = EncodeUnitResult(result);
  options_.counters->result_bytes += static_cast<int64_t>(bytes.size());
  header.mutable_result_digest()->set_sha256(Sha256Hex(bytes));
  header.mutable_result_digest()->set_size_bytes(static_cast<int64_t>(bytes.size()));
  header.set_cpu_seconds(result.cpu_seconds);
  Backoff backoff;
  while (true) {
    const absl::StatusOr<v1::SubmitUnitResultResponse> sent = link_->Submit(header, bytes);
    if (sent.ok()) return sent->outcome();
    if (!IsWorthRetrying(sent.status()) || stop_retrying_.HasBeenNotified()) return sent.status();
    backoff.Sleep(stop_retrying_);
  }
}

}  // namespace lambert::worker
