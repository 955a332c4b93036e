#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "lambert/worker/v1/worker_service.grpc.pb.h"
#include "radiosity/core/error.h"
#include "server/base/proto_duration.h"
#include "server/coordinator.h"
#include "server/rpc/chunks.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

namespace w1 = ::lambert::worker::v1;
constexpr char kJobPrefix[] = "solveJobs/";

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
  for (const ShardRange& shard : granted.step->shards()) {
    w1::MergeRange* range = lease.add_merge_ranges();
    range->set_shard(shard.shard);
    range->set_address(shard.address);
    range->set_first_patch(shard.first);
    range->set_end_patch(shard.end);
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

class SubmitReactor : public ChunkReader<w1::SubmitUnitResultRequest> {
 public:
  SubmitReactor(WorkTable* work, Identity caller, w1::SubmitUnitResultResponse* response)
      : work_(work), caller_(std::move(caller)), response_(response) {}

 private:
  absl::StatusOr<Announced> Begin(const w1::SubmitUnitResultRequest& first) override {
    const std::string& job = first.unit_key().solve_job();
    if (job.rfind(kJobPrefix, 0) == 0) submission_.job = job.substr(sizeof(kJobPrefix) - 1);
    submission_.step_number = first.unit_key().step_number();
    submission_.cpu_seconds = Seconds(first.cpu_seconds());
    for (const w1::CombinedUnit& unit : first.combined_units()) {
      submission_.units.push_back(
          {unit.lease(), unit.unit_index(), unit.result_sha256(), Seconds(unit.run_seconds())});
    }
    const std::string digest = first.result_digest().sha256();
    if (submission_.units.empty()) {
      submission_.units.push_back(
          {first.lease(), first.unit_key().unit_index(), digest, Seconds(first.run_seconds())});
    }
    for (const SubmittedUnit& unit : submission_.units) {
      const std::string session = unit.lease.substr(0, unit.lease.find("/leases/"));
      if (IsOthers(*work_, caller_, session)) return NoSession(session);
    }
    return Announced{digest, work_->MaxResultBytes(submission_.job, submission_.step_number),
                     submission_.units[0].lease};
  }
  // A result that is larger than one can be counts as an attempt, like any other bad result.
  absl::Status End(std::string& bytes) override {
    submission_.bytes = std::move(bytes);
    absl::StatusOr<SubmitOutcome> outcome = work_->Submit(submission_);
    if (!outcome.ok()) return outcome.status();
    response_->set_outcome(Encode(*outcome));
    return absl::OkStatus();
  }

  WorkTable* const work_;
  const Identity caller_;
  w1::SubmitUnitResultResponse* const response_;
  Submission submission_;
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
