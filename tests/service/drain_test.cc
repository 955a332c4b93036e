// WorkTable::Drain: how work ends when the server stops.
#include <gtest/gtest.h>

#include <thread>

#include "absl/synchronization/notification.h"
#include "radiosity/core/error.h"
#include "tests/service/work_fakes.h"

namespace lambert::server {
namespace {

class Draining : public testing::Test {
 protected:
  std::shared_ptr<PublishedStep> Publish(int units) {
    return *table_.Publish(MakeSetup("job"), MakeUnits(units));
  }

  FakeClock clock_;
  WorkTable table_{WorkOptions(), "v1", 1000, clock_.clock()};
};

TEST_F(Draining, LendsNothingAndTakesTheResultsOfWhatIsLent) {
  FakeWorker worker(&table_, "w"), idle(&table_, "idle");
  auto step = Publish(1);
  worker.Sync();
  absl::Notification told;
  table_.Sync({idle.session(), 1, {}, false}, nullptr, [&](absl::StatusOr<SyncReply> reply) {
    EXPECT_EQ(ReasonOf(reply.status()), "SHUTTING_DOWN");
    told.Notify();
  });
  std::thread draining([this] { table_.Drain(std::chrono::hours(1)); });
  told.WaitForNotification();
  worker.Sync();
  EXPECT_EQ(ReasonOf(worker.replies.back().status()), "SHUTTING_DOWN");
  EXPECT_EQ(*worker.Submit(worker.leases[0]), SubmitOutcome::kAccepted);
  draining.join();
  EXPECT_TRUE(step->Wait().ok());
}

TEST_F(Draining, DoesNotWaitLongerThanItMay) {
  FakeWorker frozen(&table_, "frozen");
  Publish(1);
  frozen.Sync();
  table_.Drain(std::chrono::milliseconds(1));
}

}  // namespace
}  // namespace lambert::server
