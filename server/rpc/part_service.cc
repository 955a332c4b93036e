// What a merge shard answers; the services of a coordinator are the others here.
#include <memory>
#include <string>
#include <utility>

#include "lambert/worker/v1/merge_service.grpc.pb.h"
#include "server/merge/merge_shard.h"
#include "server/rpc/chunks.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

namespace w1 = ::lambert::worker::v1;

w1::SubmitPartResponse::Outcome Encode(PartOutcome outcome) {
  switch (outcome) {
    case PartOutcome::kAccepted:
      return w1::SubmitPartResponse::OUTCOME_ACCEPTED;
    case PartOutcome::kDuplicate:
      return w1::SubmitPartResponse::OUTCOME_DUPLICATE;
    case PartOutcome::kSplit:
      return w1::SubmitPartResponse::OUTCOME_SPLIT;
  }
  return w1::SubmitPartResponse::OUTCOME_UNSPECIFIED;
}

class PartReactor : public ChunkReader<w1::SubmitPartRequest> {
 public:
  PartReactor(MergeShard* shard, const std::string& name, w1::SubmitPartResponse* response)
      : shard_(shard), name_(name), response_(response) {}

 private:
  absl::StatusOr<Announced> Begin(const w1::SubmitPartRequest& first) override {
    if (first.shard() != name_) {
      return MakeError(absl::StatusCode::kUnavailable,
                       {"SHARD_REPLACED", "merge shard " + first.shard(),
                        "another one listens here now", "wait for the server to notice"});
    }
    part_.step_number = first.step_number();
    for (const w1::PartUnit& unit : first.units()) {
      part_.units.push_back({unit.unit_index(), unit.ray_count()});
    }
    const absl::StatusOr<int64_t> max_bytes = shard_->MaxPartBytes(part_.step_number);
    if (!max_bytes.ok()) return max_bytes.status();
    return Announced{first.part_digest().sha256(), *max_bytes,
                     "step " + std::to_string(part_.step_number)};
  }
  absl::Status End(std::string& bytes) override {
    part_.bytes = std::move(bytes);
    const absl::StatusOr<PartOutcome> outcome = shard_->Submit(part_);
    if (!outcome.ok()) return outcome.status();
    response_->set_outcome(Encode(*outcome));
    return absl::OkStatus();
  }

  MergeShard* const shard_;
  const std::string& name_;
  w1::SubmitPartResponse* const response_;
  Part part_;
};

class PartService : public w1::PartService::CallbackService {
 public:
  PartService(MergeShard* shard, std::string name, const Doors* doors)
      : shard_(shard), name_(std::move(name)), doors_(*doors) {}

  grpc::ServerReadReactor<w1::SubmitPartRequest>* SubmitPart(
      grpc::CallbackServerContext* context, w1::SubmitPartResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kWorkers);
    if (!caller.ok()) {
      return new Refused<grpc::ServerReadReactor<w1::SubmitPartRequest>>(caller.status());
    }
    return new PartReactor(shard_, name_, response);
  }

 private:
  MergeShard* const shard_;
  const std::string name_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakePartService(MergeShard* shard, const std::string& name,
                                               const Doors* doors) {
  return std::make_unique<PartService>(shard, name, doors);
}

}  // namespace lambert::server
