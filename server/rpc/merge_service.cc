#include <memory>
#include <string>
#include <utility>

#include "lambert/worker/v1/merge_service.grpc.pb.h"
#include "server/base/proto_duration.h"
#include "server/coordinator.h"
#include "server/rpc/chunks.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

namespace w1 = ::lambert::worker::v1;

w1::MergeStep Encode(const ShardOrder& order) {
  const WorkSetup& setup = order.step->setup();
  w1::MergeStep step;
  step.set_step_number(order.step->number());
  step.set_solve_job("solveJobs/" + setup.job);
  step.set_ray_count(order.step->rays());
  step.set_patch_count(setup.patch_count);
  step.set_first_patch(order.first);
  step.set_end_patch(order.end);
  step.set_has_sightings(setup.has_sightings);
  return step;
}

// A sync that may be held. Finishes exactly once: when the table answers.
class SyncShardReactor : public grpc::ServerUnaryReactor {
 public:
  SyncShardReactor(WorkTable* work, const w1::SyncMergeShardRequest& request,
                   w1::SyncMergeShardResponse* response)
      : work_(work), shard_(request.shard()), response_(response) {
    work_->shards().Sync({request.shard(), request.address(), request.unit_version(),
                          request.seen_version(), request.draining()},
                         this, [this](absl::StatusOr<ShardOrders> orders) { Answer(orders); });
  }
  void OnCancel() override { work_->shards().CancelSync(shard_, this); }
  void OnDone() override { delete this; }

 private:
  void Answer(const absl::StatusOr<ShardOrders>& orders) {
    if (!orders.ok()) return Finish(ToGrpc(orders.status()));
    response_->set_version(orders->version);
    for (const ShardOrder& order : orders->orders) *response_->add_steps() = Encode(order);
    *response_->mutable_sync_interval() = ToProto(work_->options().sync_interval);
    Finish(grpc::Status::OK);
  }

  WorkTable* const work_;
  const std::string shard_;
  w1::SyncMergeShardResponse* const response_;
};

class RangeReactor : public ChunkReader<w1::SubmitMergedRangeRequest> {
 public:
  RangeReactor(ShardTable* shards, w1::SubmitMergedRangeResponse* response)
      : shards_(shards), response_(response) {}

 private:
  absl::StatusOr<Announced> Begin(const w1::SubmitMergedRangeRequest& first) override {
    shard_ = first.shard();
    step_number_ = first.step_number();
    return Announced{first.range_digest().sha256(), shards_->MaxRangeBytes(step_number_), shard_};
  }
  absl::Status End(std::string& bytes) override {
    const absl::StatusOr<bool> taken = shards_->TakeRange(shard_, step_number_, bytes);
    response_->set_is_obsolete(taken.ok() && !*taken);
    return taken.status();
  }

  ShardTable* const shards_;
  w1::SubmitMergedRangeResponse* const response_;
  std::string shard_;
  int64_t step_number_ = 0;
};

class MergeService : public w1::MergeService::CallbackService {
 public:
  MergeService(WorkTable* work, const Doors* doors) : work_(work), doors_(*doors) {}

  grpc::ServerUnaryReactor* SyncMergeShard(grpc::CallbackServerContext* context,
                                           const w1::SyncMergeShardRequest* request,
                                           w1::SyncMergeShardResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kMergers);
    if (!caller.ok()) return Reply(context, caller.status());
    return new SyncShardReactor(work_, *request, response);
  }
  grpc::ServerReadReactor<w1::SubmitMergedRangeRequest>* SubmitMergedRange(
      grpc::CallbackServerContext* context, w1::SubmitMergedRangeResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kMergers);
    if (!caller.ok()) {
      return new Refused<grpc::ServerReadReactor<w1::SubmitMergedRangeRequest>>(caller.status());
    }
    return new RangeReactor(&work_->shards(), response);
  }

 private:
  WorkTable* const work_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeMergeService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<MergeService>(&coordinator->work(), doors);
}

}  // namespace lambert::server
