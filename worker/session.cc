#include "worker/session.h"

#include <utility>
#include <vector>

#include "google/protobuf/util/time_util.h"
#include "net/backoff.h"
#include "radiosity/shoot/shooter.h"

namespace lambert::worker {

using google::protobuf::util::TimeUtil;

Session::Session(ServerLink* link, LeaseBook* book, const WorkerOptions& options)
    : link_(link), book_(book), options_(options), thread_([this] { Work(); }) {}

Session::~Session() { End(); }

void Session::Report() {
  has_news_ = true;
  link_->InterruptSync();
}

void Session::StartDraining() {
  if (draining_.HasBeenNotified()) return;
  draining_.Notify();
  Report();
}

void Session::End() {
  if (!thread_.joinable()) return;
  StartDraining();
  ended_.Notify();
  link_->InterruptSync();
  thread_.join();
  options_.counters->in_session = false;
  if (session_.has_value()) link_->DeleteSession(session_->name());
}

void Session::Work() {
  Backoff backoff;
  while (!ended_.HasBeenNotified() && !refused_) {
    if (!session_.has_value()) {
      if (draining_.HasBeenNotified()) return;
      if (!Open()) {
        backoff.Sleep(draining_);
        continue;
      }
    }
    const absl::Status status = Exchange();
    if (status.ok()) {
      backoff.Reset();
    } else if (absl::IsNotFound(status) || absl::IsAborted(status)) {
      options_.log("the session has ended: " + std::string(status.message()));
      session_.reset();
      options_.counters->in_session = false;
      book_->Forget();
    } else if (!absl::IsCancelled(status)) {
      backoff.Sleep(draining_.HasBeenNotified() ? ended_ : draining_);
    }
  }
}

bool Session::Open() {
  v1::CreateWorkerSessionRequest request;
  request.set_worker_id(options_.worker_id);
  request.set_slot_count(options_.slots);
  request.set_unit_version(options_.unit_version.empty() ? UnitVersion() : options_.unit_version);
  absl::StatusOr<v1::WorkerSession> session = link_->CreateSession(request);
  if (session.ok()) {
    options_.log("at work as " + session->name());
    session_ = *std::move(session);
    options_.counters->in_session = true;
    sequence_ = 1;
    return true;
  }
  if (absl::IsFailedPrecondition(session.status()) || absl::IsInvalidArgument(session.status()) ||
      absl::IsUnauthenticated(session.status()) || absl::IsPermissionDenied(session.status())) {
    refused_ = true;
    options_.on_refused(session.status());
  } else {
    options_.log("no session yet: " + std::string(session.status().message()));
  }
  return false;
}

absl::Status Session::Exchange() {
  // A new exchange, so that the server looks at the reports: what is not listed any more goes back.
  if (has_news_.exchange(false)) ++sequence_;
  v1::SyncWorkerSessionRequest request;
  request.set_name(session_->name());
  request.set_sequence(sequence_);
  request.set_draining(draining_.HasBeenNotified());
  const std::vector<v1::LeaseReport> reports = book_->Reports();
  for (const v1::LeaseReport& report : reports) *request.add_reports() = report;
  absl::StatusOr<v1::SyncWorkerSessionResponse> response = link_->Sync(
      request, absl::Nanoseconds(TimeUtil::DurationToNanoseconds(session_->sync_interval())),
      [this] { return ended_.HasBeenNotified() || has_news_; });
  if (!response.ok()) return response.status();
  ++sequence_;
  book_->Confirm(reports);
  for (const std::string& lease : response->revoked_leases()) book_->Revoke(lease);
  for (v1::Lease& lease : *response->mutable_leases()) book_->Add(std::move(lease));
  return absl::OkStatus();
}

}  // namespace lambert::worker
