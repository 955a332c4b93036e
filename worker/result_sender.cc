#include "worker/result_sender.h"

#include "radiosity/core/digest.h"
#include "worker/backoff.h"

namespace lambert::worker {

ResultSender::ResultSender(ServerLink* link, LeaseBook* book, const WorkerOptions& options)
    : link_(link), book_(book), options_(options), thread_([this] { Work(); }) {}

ResultSender::~ResultSender() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  thread_.join();
}

void ResultSender::Send(const v1::Lease& lease, UnitResult result, double run_seconds) {
  absl::MutexLock lock(&mutex_);
  auto has_room = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return items_.size() + sending_ <= static_cast<size_t>(options_.slots);
  };
  mutex_.Await(absl::Condition(&has_room));
  items_.push_back({lease, std::move(result), run_seconds});
}

void ResultSender::StopRetrying() { stop_retrying_.Notify(); }

std::vector<ResultSender::Item> ResultSender::TakeBatch() {
  std::vector<Item> batch;
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
    std::vector<Item> batch;
    {
      absl::MutexLock lock(&mutex_);
      auto ready = [this]()
                       ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return stopping_ || !items_.empty(); };
      mutex_.Await(absl::Condition(&ready));
      if (items_.empty()) return;
      batch = TakeBatch();
      sending_ = batch.size();
    }
    batch.size() > 1 ? SendAll(batch) : SendOne(batch[0]);
    for (const Item& item : batch) book_->Remove(item.lease.name());
    absl::MutexLock lock(&mutex_);
    sending_ = 0;
  }
}

void ResultSender::SendAll(const std::vector<Item>& items) {
  v1::SubmitUnitResultRequest header;
  UnitResult sum;
  for (const Item& item : items) {
    MergeResult(item.result, sum);
    v1::CombinedUnit* unit = header.add_combined_units();
    unit->set_lease(item.lease.name());
    unit->set_unit_index(item.lease.unit_key().unit_index());
    unit->set_result_sha256(Sha256Hex(EncodeUnitResult(item.result)));
    unit->set_run_seconds(item.run_seconds);
  }
  header.set_lease(items[0].lease.name());
  *header.mutable_unit_key() = items[0].lease.unit_key();
  header.set_run_seconds(items[0].run_seconds);
  const absl::StatusOr<Outcome> outcome = Offer(std::move(header), sum);
  if (!outcome.ok()) {
    for (const Item& item : items) LogRefusal(outcome.status(), item);
  } else if (*outcome == v1::SubmitUnitResultResponse::OUTCOME_SPLIT) {
    for (const Item& item : items) SendOne(item);
  }
}

void ResultSender::SendOne(const Item& item) {
  v1::SubmitUnitResultRequest header;
  header.set_lease(item.lease.name());
  *header.mutable_unit_key() = item.lease.unit_key();
  header.set_run_seconds(item.run_seconds);
  const absl::StatusOr<Outcome> outcome = Offer(std::move(header), item.result);
  if (!outcome.ok()) LogRefusal(outcome.status(), item);
}

void ResultSender::LogRefusal(const absl::Status& status, const Item& item) const {
  options_.log(
      {"the result was not taken: " + std::string(status.message()), SubjectOf(item.lease)});
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
    const bool is_worth_retrying = absl::IsUnavailable(sent.status()) ||
                                   absl::IsDeadlineExceeded(sent.status()) ||
                                   absl::IsCancelled(sent.status());  // by a server that goes
    if (!is_worth_retrying || stop_retrying_.HasBeenNotified()) return sent.status();
    backoff.Sleep(stop_retrying_);
  }
}

}  // namespace lambert::worker
