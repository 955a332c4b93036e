#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "google/protobuf/util/time_util.h"
#include "lambert/worker/v1/worker_service.grpc.pb.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

namespace w1 = ::lambert::worker::v1;
using google::protobuf::util::TimeUtil;

constexpr char kJobPrefix[] = "solveJobs/";

google::protobuf::Duration ToProto(Duration duration) {
  return TimeUtil::NanosecondsToDuration(
      std::chrono::duration_cast<std::chrono::nanoseconds>(duration).count());
}

w1::Lease Encode(const GrantedLease& granted) {
  const WorkSetup& setup = granted.step->setup();
  w1::Lease lease;
  lease.set_name(granted.name);
  lease.mutable_unit_key()->set_solve_job(kJobPrefix + setup.job);
  lease.mutable_unit_key()->set_step_number(granted.step->number());
  lease.mutable_unit_key()->set_unit_index(granted.unit);
  lease.set_unit(EncodeUnit(granted.step->Unit({granted.grains})));
  lease.mutable_patch_set_digest()->set_sha256(setup.patch_set_sha256);
  lease.mutable_patch_set_digest()->set_size_bytes(setup.patch_set_bytes);
  lease.set_shoot_options(setup.shoot_options);
  if (!setup.gather_task_sha256.empty()) {
    lease.mutable_gather_task_digest()->set_sha256(setup.gather_task_sha256);
    lease.mutable_gather_task_digest()->set_size_bytes(setup.gather_task_bytes);
  }
  return lease;
}

w1::SubmitUnitResultResponse::Outcome Encode(SubmitOutcome outcome) {
  switch (outcome) {
    case SubmitOutcome::kAccepted:
      return w1::SubmitUnitResultResponse::OUTCOME_ACCEPTED;
    case SubmitOutcome::kDuplicate:
      return w1::SubmitUnitResultResponse::OUTCOME_DUPLICATE;
    case SubmitOutcome::kObsolete:
      return w1::SubmitUnitResultResponse::OUTCOME_OBSOLETE;
    case SubmitOutcome::kSplit:
      return w1::SubmitUnitResultResponse::OUTCOME_SPLIT;
  }
  return w1::SubmitUnitResultResponse::OUTCOME_UNSPECIFIED;
}

SyncRequest Decode(const w1::SyncWorkerSessionRequest& request) {
  SyncRequest decoded{request.name(), request.sequence(), {}, request.draining()};
  for (const w1::LeaseReport& report : request.reports()) {
    decoded.reports.push_back(
        {report.lease(), report.state() == w1::LeaseReport::STATE_FAILED, report.error_message()});
  }
  return decoded;
}

// A sync that may be held. Finishes exactly once: when the table answers, which it also does when
// the worker has gone.
class SyncReactor : public grpc::ServerUnaryReactor {
 public:
  SyncReactor(WorkTable* work, const w1::SyncWorkerSessionRequest& request,
              w1::SyncWorkerSessionResponse* response)
      : work_(work), session_(request.name()), response_(response) {
    work_->Sync(Decode(request), this,
                [this](absl::StatusOr<SyncReply> reply) { Answer(std::move(reply)); });
  }
  void OnCancel() override { work_->CancelSync(session_, this); }
  void OnDone() override { delete this; }

 private:
  void Answer(absl::StatusOr<SyncReply> reply) {
    if (!reply.ok()) return Finish(ToGrpc(reply.status()));
    response_->set_sequence(reply->sequence);
    for (const GrantedLease& lease : reply->leases) *response_->add_leases() = Encode(lease);
    for (std::string& lease : reply->revoked) response_->add_revoked_leases(std::move(lease));
    Finish(grpc::Status::OK);
  }

  WorkTable* const work_;
  const std::string session_;
  w1::SyncWorkerSessionResponse* const response_;
};

// What a worker says, as far as it can be true.
double Seconds(double said) { return std::isfinite(said) && said > 0 ? said : 0; }

// A worker's sessions and leases are its own: of a worker with a name, "NAME." stands before the
// ids of its sessions' workers.
bool IsOthers(const WorkTable& work, const Identity& caller, const std::string& session) {
  if (caller.name.empty()) return false;
  const std::string worker = work.WorkerOfSession(session);
  return !worker.empty() && worker.rfind(caller.name + ".", 0) != 0;
}

absl::Status NoSession(const std::string& session) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"SESSION_NOT_FOUND", session, "there is no such session", "open a new one"});
}

class SubmitReactor : public grpc::ServerReadReactor<w1::SubmitUnitResultRequest> {
 public:
  SubmitReactor(WorkTable* work, Identity caller, w1::SubmitUnitResultResponse* response)
      : work_(work), caller_(std::move(caller)), response_(response) {
    StartRead(&request_);
  }
  void OnReadDone(bool ok) override {
    if (!ok) return Finish(ToGrpc(IsWhole() ? Submit() : Mismatch()));
    if (is_first_) {
      TakeHeader();
      for (const SubmittedUnit& unit : submission_.units) {
        const std::string session = unit.lease.substr(0, unit.lease.find("/leases/"));
        if (IsOthers(*work_, caller_, session)) return Finish(ToGrpc(NoSession(session)));
      }
      // Nobody needs the rest of a result whose step is over.
      if (max_bytes_ == 0) return Finish(ToGrpc(Submit()));
    }
    submission_.bytes += request_.data();
    if (static_cast<int64_t>(submission_.bytes.size()) > max_bytes_) {
      // Larger than a result can be: counts as an attempt, like any other bad result.
      return Finish(ToGrpc(Submit()));
    }
    StartRead(&request_);
  }
  void OnDone() override { delete this; }

 private:
  void TakeHeader() {
    is_first_ = false;
    const std::string& job = request_.unit_key().solve_job();
    if (job.rfind(kJobPrefix, 0) == 0) submission_.job = job.substr(sizeof(kJobPrefix) - 1);
    submission_.step_number = request_.unit_key().step_number();
    digest_ = request_.result_digest().sha256();
    submission_.cpu_seconds = Seconds(request_.cpu_seconds());
    for (const w1::CombinedUnit& unit : request_.combined_units()) {
      submission_.units.push_back(
          {unit.lease(), unit.unit_index(), unit.result_sha256(), Seconds(unit.run_seconds())});
    }
    if (submission_.units.empty()) {
      submission_.units.push_back({request_.lease(), request_.unit_key().unit_index(), digest_,
                                   Seconds(request_.run_seconds())});
    }
    max_bytes_ = work_->MaxResultBytes(submission_.job, submission_.step_number);
  }
  bool IsWhole() const { return !is_first_ && Sha256Hex(submission_.bytes) == digest_; }
  absl::Status Mismatch() const {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"DIGEST_MISMATCH", is_first_ ? "lease" : submission_.units[0].lease,
         "the result that arrived is not the one that was announced", "send it again"});
  }
  absl::Status Submit() {
    absl::StatusOr<SubmitOutcome> outcome = work_->Submit(submission_);
    if (!outcome.ok()) return outcome.status();
    response_->set_outcome(Encode(*outcome));
    return absl::OkStatus();
  }

  WorkTable* const work_;
  const Identity caller_;
  w1::SubmitUnitResultResponse* const response_;
  w1::SubmitUnitResultRequest request_;
  Submission submission_;
  std::string digest_;  // that was announced
  int64_t max_bytes_ = 0;
  bool is_first_ = true;
};

class WorkerService : public w1::WorkerService::CallbackService {
 public:
  WorkerService(WorkTable* work, const Doors* doors) : work_(work), doors_(*doors) {}

  grpc::ServerUnaryReactor* CreateWorkerSession(grpc::CallbackServerContext* context,
                                                const w1::CreateWorkerSessionRequest* request,
                                                w1::WorkerSession* response) override {
    return Answer(context, doors_, Guests::kWorkers, response,
                  [&](const Identity& caller) { return OpenSession(caller, *request); });
  }
  grpc::ServerUnaryReactor* SyncWorkerSession(grpc::CallbackServerContext* context,
                                              const w1::SyncWorkerSessionRequest* request,
                                              w1::SyncWorkerSessionResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kWorkers);
    if (!caller.ok()) return Reply(context, caller.status());
    if (IsOthers(*work_, *caller, request->name())) {
      return Reply(context, NoSession(request->name()));
    }
    return new SyncReactor(work_, *request, response);
  }
  grpc::ServerReadReactor<w1::SubmitUnitResultRequest>* SubmitUnitResult(
      grpc::CallbackServerContext* context, w1::SubmitUnitResultResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kWorkers);
    if (!caller.ok()) {
      return new Refused<grpc::ServerReadReactor<w1::SubmitUnitResultRequest>>(caller.status());
    }
    return new SubmitReactor(work_, *caller, response);
  }
  grpc::ServerUnaryReactor* DeleteWorkerSession(grpc::CallbackServerContext* context,
                                                const w1::DeleteWorkerSessionRequest* request,
                                                google::protobuf::Empty*) override {
    return Answer(context, doors_, Guests::kWorkers, [&](const Identity& caller) {
      if (!IsOthers(*work_, caller, request->name())) work_->CloseSession(request->name());
      return absl::OkStatus();
    });
  }

 private:
  absl::StatusOr<w1::WorkerSession> OpenSession(const Identity& caller,
                                                const w1::CreateWorkerSessionRequest& request) {
    const std::string prefix = caller.name.empty() ? "" : caller.name + ".";
    absl::StatusOr<std::string> name = work_->OpenSession(
        prefix + request.worker_id(), request.slot_count(), request.unit_version());
    if (!name.ok()) return name.status();
    w1::WorkerSession session;
    session.set_name(*name);
    *session.mutable_sync_interval() = ToProto(work_->options().sync_interval);
    *session.mutable_expire_duration() = ToProto(work_->options().session_expiry);
    return session;
  }

  WorkTable* const work_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeWorkerService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<WorkerService>(&coordinator->work(), doors);
}

}  // namespace lambert::server
