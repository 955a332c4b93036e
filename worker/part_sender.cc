#include "worker/part_sender.h"

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <thread>
#include <utility>

#include "lambert/worker/v1/merge_service.grpc.pb.h"
#include "net/backoff.h"
#include "net/calls.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"

namespace lambert::worker {
namespace {

using Outcome = v1::SubmitPartResponse::Outcome;

// The server loses a silent shard sooner than that, and revokes the leases that name it.
constexpr absl::Duration kLongestTry = absl::Seconds(30);
// A shard that does not answer may be lost already: look again soon.
constexpr absl::Duration kPartDeadline = absl::Seconds(5);
constexpr int64_t kBytesPerSecond = int64_t{4} << 20;

absl::Status Failed(const v1::MergeRange& range, const absl::Status& why) {
  return MakeError(absl::StatusCode::kUnavailable,
                   {"SHARD_UNREACHABLE", "merge shard " + range.address(),
                    std::string(why.message()), "see that workers reach lambert-merger there"});
}

}  // namespace

class PartSender::Link {
 public:
  explicit Link(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(v1::PartService::NewStub(channel)) {}

  absl::StatusOr<v1::SubmitPartResponse> Submit(const v1::SubmitPartRequest& header,
                                                const std::string& bytes) {
    grpc::ClientContext context;
    SetDeadline(context, kPartDeadline + absl::Seconds(bytes.size() / kBytesPerSecond));
    v1::SubmitPartResponse response;
    auto writer = stub_->SubmitPart(&context, &response);
    const absl::Status status = WriteInChunks(*writer, header, bytes);
    if (!status.ok()) return status;
    return response;
  }

 private:
  const std::unique_ptr<v1::PartService::Stub> stub_;
};

PartSender::PartSender(LeaseBook* book, const WorkerOptions& options,
                       const absl::Notification* stop)
    : book_(book), options_(options), stop_(stop) {}
PartSender::~PartSender() = default;

absl::StatusOr<std::shared_ptr<PartSender::Link>> PartSender::LinkTo(const std::string& address) {
  std::shared_ptr<Link>& link = links_[address];
  if (link != nullptr) return link;
  absl::StatusOr<std::shared_ptr<grpc::Channel>> channel = options_.connect(address);
  if (!channel.ok()) return channel.status();
  return link = std::make_shared<Link>(*channel);
}

absl::StatusOr<bool> PartSender::Send(const std::vector<FinishedUnit>& units,
                                      const UnitResult& sum) {
  const auto& ranges = units[0].lease.merge_ranges();
  std::erase_if(links_, [&ranges](const auto& link) {
    return std::none_of(ranges.begin(), ranges.end(), [&link](const v1::MergeRange& range) {
      return range.address() == link.first;
    });
  });
  std::vector<absl::StatusOr<bool>> sent(static_cast<size_t>(ranges.size()), true);
  std::vector<std::thread> threads;
  for (int i = 0; i < ranges.size(); ++i) {
    absl::StatusOr<std::shared_ptr<Link>> link = LinkTo(ranges[i].address());
    if (!link.ok()) {
      sent[i] = Failed(ranges[i], link.status());
      continue;
    }
    threads.emplace_back(
        [&, i, link = *std::move(link)] { sent[i] = SendRange(*link, ranges[i], units, sum); });
  }
  for (std::thread& thread : threads) thread.join();
  bool is_complete = true;
  for (const absl::StatusOr<bool>& one : sent) {
    if (!one.ok()) return one.status();
    is_complete = is_complete && *one;
  }
  return is_complete;
}

absl::StatusOr<bool> PartSender::SendRange(Link& link, const v1::MergeRange& range,
                                           const std::vector<FinishedUnit>& units,
                                           const UnitResult& sum) const {
  std::vector<const FinishedUnit*> all;
  for (const FinishedUnit& unit : units) all.push_back(&unit);
  absl::StatusOr<Outcome> outcome = Offer(link, range, all, sum);
  if (outcome.ok() && *outcome == v1::SubmitPartResponse::OUTCOME_SPLIT) {
    for (const FinishedUnit& unit : units) {
      outcome = Offer(link, range, {&unit}, unit.result);
      if (!outcome.ok() || *outcome == v1::SubmitPartResponse::OUTCOME_UNSPECIFIED) break;
    }
  }
  if (!outcome.ok()) return Failed(range, outcome.status());
  return *outcome != v1::SubmitPartResponse::OUTCOME_UNSPECIFIED;
}

absl::StatusOr<Outcome> PartSender::Offer(Link& link, const v1::MergeRange& range,
                                          const std::vector<const FinishedUnit*>& units,
                                          const UnitResult& sum) const {
  const std::string bytes = EncodeUnitResult(RangeOf(sum, range.first_patch(), range.end_patch()));
  options_.counters->result_bytes += static_cast<int64_t>(bytes.size());
  v1::SubmitPartRequest header;
  header.set_shard(range.shard());
  header.set_step_number(units[0]->lease.unit_key().step_number());
  for (const FinishedUnit* unit : units) {
    v1::PartUnit* named = header.add_units();
    named->set_unit_index(unit->lease.unit_key().unit_index());
    named->set_ray_count(unit->ray_count);
  }
  header.mutable_part_digest()->set_sha256(Sha256Hex(bytes));
  header.mutable_part_digest()->set_size_bytes(static_cast<int64_t>(bytes.size()));
  const absl::Time give_up = absl::Now() + kLongestTry;
  const auto is_wanted = [this](const FinishedUnit* unit) {
    return book_->IsWanted(unit->lease.name());
  };
  Backoff backoff;
  while (true) {
    const absl::StatusOr<v1::SubmitPartResponse> sent = link.Submit(header, bytes);
    if (sent.ok()) return sent->outcome();
    if (std::none_of(units.begin(), units.end(), is_wanted)) {
      return v1::SubmitPartResponse::OUTCOME_UNSPECIFIED;
    }
    if (!IsWorthRetrying(sent.status()) || stop_->HasBeenNotified() || absl::Now() > give_up) {
      return sent.status();
    }
    backoff.Sleep(*stop_);
  }
}

}  // namespace lambert::worker
