#include "server/merge/shard_session.h"

#include <grpcpp/grpcpp.h>

#include <optional>
#include <utility>
#include <vector>

#include "google/protobuf/util/time_util.h"
#include "lambert/worker/v1/merge_service.grpc.pb.h"
#include "net/backoff.h"
#include "net/calls.h"
#include "radiosity/core/digest.h"
#include "radiosity/shoot/shooter.h"

namespace lambert::server {
namespace {

namespace w1 = ::lambert::worker::v1;

constexpr absl::Duration kFirstHold = absl::Seconds(10);  // before the server has said its own
constexpr absl::Duration kPause = absl::Milliseconds(20);

MergeStep Decode(const w1::MergeStep& step) {
  return {step.solve_job(),   step.step_number(), step.ray_count(),    step.patch_count(),
          step.first_patch(), step.end_patch(),   step.has_sightings()};
}

bool IsForEver(const absl::Status& status) {
  return absl::IsFailedPrecondition(status) || absl::IsInvalidArgument(status) ||
         absl::IsUnauthenticated(status) || absl::IsPermissionDenied(status);
}

}  // namespace

class ShardSession::Calls {
 public:
  explicit Calls(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(w1::MergeService::NewStub(channel)) {}

  // CANCELLED where it is interrupted, or `may_begin` says no.
  absl::StatusOr<w1::SyncMergeShardResponse> Sync(const w1::SyncMergeShardRequest& request,
                                                  absl::Duration hold,
                                                  const std::function<bool()>& may_begin) {
    grpc::ClientContext context;
    SetDeadline(context, hold + absl::Seconds(5));
    {
      absl::MutexLock lock(&mutex_);
      if (!may_begin()) return absl::CancelledError("interrupted");
      sync_ = &context;
    }
    w1::SyncMergeShardResponse response;
    const grpc::Status status = stub_->SyncMergeShard(&context, request, &response);
    absl::MutexLock lock(&mutex_);
    sync_ = nullptr;
    return Result(status, std::move(response));
  }
  void InterruptSync() {
    absl::MutexLock lock(&mutex_);
    if (sync_ != nullptr) sync_->TryCancel();
  }
  absl::StatusOr<w1::SubmitMergedRangeResponse> Submit(const w1::SubmitMergedRangeRequest& header,
                                                       const std::string& bytes) {
    grpc::ClientContext context;
    SetDeadline(context, TransferDeadline(static_cast<int64_t>(bytes.size())));
    w1::SubmitMergedRangeResponse response;
    auto writer = stub_->SubmitMergedRange(&context, &response);
    const absl::Status status = WriteInChunks(*writer, header, bytes);
    if (!status.ok()) return status;
    return response;
  }

 private:
  const std::unique_ptr<w1::MergeService::Stub> stub_;
  absl::Mutex mutex_;
  grpc::ClientContext* sync_ ABSL_GUARDED_BY(mutex_) = nullptr;  // that is under way
};

ShardSession::ShardSession(std::shared_ptr<grpc::Channel> channel, MergeShard* shard,
                           const ShardSessionOptions& options)
    : options_(options), shard_(shard), calls_(std::make_unique<Calls>(channel)) {
  shard_->Open();
  follower_ = std::thread([this] { Follow(); });
  deliverer_ = std::thread([this] { HandOver(); });
}

ShardSession::~ShardSession() {
  ended_.Notify();
  calls_->InterruptSync();
  shard_->Close();
  follower_.join();
  deliverer_.join();
  shard_->counters().in_session = false;
}

void ShardSession::Drain(absl::Duration grace) {
  draining_.Notify();
  calls_->InterruptSync();
  const absl::Time end = absl::Now() + grace;
  while (shard_->step_count() > 0 && absl::Now() < end) absl::SleepFor(kPause);
}

void ShardSession::Follow() {
  w1::SyncMergeShardRequest request;
  request.set_shard(options_.name);
  request.set_address(options_.address);
  request.set_unit_version(UnitVersion());
  absl::Duration hold = kFirstHold;
  bool is_known = false;
  Backoff backoff;
  while (!ended_.HasBeenNotified()) {
    const bool drains = draining_.HasBeenNotified();
    request.set_draining(drains);
    const absl::StatusOr<w1::SyncMergeShardResponse> response = calls_->Sync(request, hold, [&] {
      return !ended_.HasBeenNotified() && draining_.HasBeenNotified() == drains;
    });
    if (response.ok()) {
      if (!is_known) options_.log("at work as merge shard " + options_.name);
      is_known = true;
      shard_->counters().in_session = true;
      backoff.Reset();
      std::vector<MergeStep> steps;
      for (const w1::MergeStep& step : response->steps()) steps.push_back(Decode(step));
      shard_->SetSteps(steps);
      request.set_seen_version(response->version());
      hold = absl::Nanoseconds(
          google::protobuf::util::TimeUtil::DurationToNanoseconds(response->sync_interval()));
    } else if (IsForEver(response.status())) {
      return options_.on_refused(response.status());
    } else if (!absl::IsCancelled(response.status())) {
      if (is_known) options_.log("no server: " + std::string(response.status().message()));
      is_known = false;
      shard_->counters().in_session = false;
      request.set_seen_version(0);
      backoff.Sleep(ended_);
    }
  }
}

void ShardSession::HandOver() {
  while (std::optional<MergedRange> range = shard_->TakeWhole()) HandOver(*range);
}

void ShardSession::HandOver(const MergedRange& range) {
  w1::SubmitMergedRangeRequest header;
  header.set_shard(options_.name);
  header.set_step_number(range.step.number);
  header.set_solve_job(range.step.job);
  header.mutable_range_digest()->set_sha256(Sha256Hex(range.bytes));
  header.mutable_range_digest()->set_size_bytes(static_cast<int64_t>(range.bytes.size()));
  Backoff backoff;
  while (shard_->Takes(range.step.number)) {
    const absl::StatusOr<w1::SubmitMergedRangeResponse> sent = calls_->Submit(header, range.bytes);
    if (sent.ok()) return;
    if (!IsWorthRetrying(sent.status())) {
      return options_.log({"a sum was not taken: " + std::string(sent.status().message()),
                           {range.step.job, range.step.number}});
    }
    backoff.Sleep(ended_);
    if (ended_.HasBeenNotified()) return;
  }
}

}  // namespace lambert::server
