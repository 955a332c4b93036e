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
    return items_.size() <= static_cast<size_t>(options_.slots);
  };
  mutex_.Await(absl::Condition(&has_room));
  items_.push_back({lease, std::move(result), run_seconds});
}

void ResultSender::StopRetrying() { stop_retrying_.Notify(); }

void ResultSender::Work() {
  while (true) {
    Item item;
    {
      absl::MutexLock lock(&mutex_);
      auto ready = [this]()
                       ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return stopping_ || !items_.empty(); };
      mutex_.Await(absl::Condition(&ready));
      if (items_.empty()) return;
      item = std::move(items_.front());
      items_.pop_front();
    }
    SendOne(item);
    book_->Remove(item.lease.name());
  }
}

void ResultSender::SendOne(const Item& item) {
  const std::string bytes = EncodeUnitResult(item.result);
  options_.counters->result_bytes += static_cast<int64_t>(bytes.size());
  v1::SubmitUnitResultRequest header;
  header.set_lease(item.lease.name());
  *header.mutable_unit_key() = item.lease.unit_key();
  header.mutable_result_digest()->set_sha256(Sha256Hex(bytes));
  header.mutable_result_digest()->set_size_bytes(static_cast<int64_t>(bytes.size()));
  header.set_cpu_seconds(item.result.cpu_seconds);
  header.set_run_seconds(item.run_seconds);
  Backoff backoff;
  while (true) {
    const absl::StatusOr<v1::SubmitUnitResultResponse> sent = link_->Submit(header, bytes);
    if (sent.ok()) return;
    const bool is_worth_retrying = absl::IsUnavailable(sent.status()) ||
                                   absl::IsDeadlineExceeded(sent.status()) ||
                                   absl::IsCancelled(sent.status());  // by a server that goes
    if (!is_worth_retrying || stop_retrying_.HasBeenNotified()) {
      options_.log({"the result was not taken: " + std::string(sent.status().message()),
                    SubjectOf(item.lease)});
      return;
    }
    backoff.Sleep(stop_retrying_);
  }
}

}  // namespace lambert::worker
