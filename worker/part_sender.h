// Sends results in parts to the merge shards that the leases name, all shards at once.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/synchronization/notification.h"
#include "lambert/worker/v1/worker_service.pb.h"
#include "radiosity/shoot/unit.h"
#include "worker/lease_book.h"
#include "worker/worker.h"

namespace lambert::worker {

// A unit that ended, and its result.
struct FinishedUnit {
  v1::Lease lease;
  UnitResult result;
  int64_t ray_count = 0;   // of the unit; where they go on the result has more
  double run_seconds = 0;  // wall-clock time that it took
};

// One thread.
class PartSender {
 public:
  // From when `stop` is notified on, a part is offered once only.
  PartSender(LeaseBook* book, const WorkerOptions& options, const absl::Notification* stop);
  ~PartSender();

  // True when every shard has its part of every unit; false when nobody wants the units any more.
  // `sum`: of their results. UNAVAILABLE where a shard could not be reached for half a minute, or
  // refused. Requires: at least one unit; all are of one step that has shards.
  absl::StatusOr<bool> Send(const std::vector<FinishedUnit>& units, const UnitResult& sum);

 private:
  class Link;
  // To a shard, kept from one call to the next.
  absl::StatusOr<std::shared_ptr<Link>> LinkTo(const std::string& address);
  absl::StatusOr<bool> SendRange(Link& link, const v1::MergeRange& range,
                                 const std::vector<FinishedUnit>& units,
                                 const UnitResult& sum) const;
  // Offers a part until it is answered; UNSPECIFIED where nobody wants the units any more.
  absl::StatusOr<v1::SubmitPartResponse::Outcome> Offer(
      Link& link, const v1::MergeRange& range, const std::vector<const FinishedUnit*>& units,
      const UnitResult& sum) const;

  LeaseBook* const book_;
  const WorkerOptions options_;
  const absl::Notification* const stop_;
  std::map<std::string, std::shared_ptr<Link>> links_;  // by address
};

}  // namespace lambert::worker
