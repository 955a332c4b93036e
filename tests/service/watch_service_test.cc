#include "radiosity/core/error.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

class WatchService : public ServiceFixture {
 protected:
  // A stream of a job's news, as yet unread.
  auto StartToWatch(const v1::SolveJob& job, grpc::ClientContext& context) {
    v1::WatchSnapshotsRequest watch;
    watch.set_parent(job.name());
    return snapshots()->WatchSnapshots(&context, watch);
  }
};

TEST_F(WatchService, AWatcherResumesAfterTheVersionThatItHas) {
  AddWorker();
  const v1::SolveJob job = CreateJob();
  const int64_t last = Watch(job.name()).snapshots.back().version();
  EXPECT_TRUE(Watch(job.name(), last).snapshots.empty());
  const Watched again = Watch(job.name(), last - 1);
  ASSERT_EQ(again.snapshots.size(), 1u);
  EXPECT_EQ(again.snapshots[0].version(), last);
  EXPECT_FALSE(again.payload.empty());
}

TEST_F(WatchService, DescribesTheSnapshotsOfAJob) {
  AddWorker();
  const v1::SolveJob job = CreateJob();
  Watch(job.name());
  v1::ListSnapshotsRequest list;
  list.set_parent(job.name());
  v1::ListSnapshotsResponse page;
  grpc::ClientContext listing;
  ASSERT_TRUE(snapshots()->ListSnapshots(&listing, list, &page).ok());
  ASSERT_GE(page.snapshots_size(), 1);
  v1::GetSnapshotRequest get;
  v1::Snapshot snapshot;
  get.set_name(job.name() + "/snapshots/latest");
  grpc::ClientContext getting, missing, nowhere;
  ASSERT_TRUE(snapshots()->GetSnapshot(&getting, get, &snapshot).ok());
  EXPECT_EQ(snapshot.name(), page.snapshots(page.snapshots_size() - 1).name());
  get.set_name(job.name() + "/snapshots/999999");
  EXPECT_EQ(ReasonOf(snapshots()->GetSnapshot(&missing, get, &snapshot)), "SNAPSHOT_NOT_FOUND");
  get.set_name("solveJobs/none/snapshots/1");
  EXPECT_EQ(ReasonOf(snapshots()->GetSnapshot(&nowhere, get, &snapshot)), "JOB_NOT_FOUND");
}

TEST_F(WatchService, WatchingNoJobIsAnError) {
  EXPECT_EQ(ReasonOf(Watch("solveJobs/none").status), "JOB_NOT_FOUND");
}

TEST_F(WatchService, AWatcherThatGoesAwayHoldsNothingUp) {
  const v1::SolveJob job = CreateJob();
  grpc::ClientContext context;
  v1::WatchSnapshotsResponse news;
  auto reader = StartToWatch(job, context);
  ASSERT_TRUE(reader->Read(&news));
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  AddWorker();
  EXPECT_EQ(Watch(job.name()).ended.state(), v1::SolveJob::STATE_SUCCEEDED);
}

TEST_F(WatchService, ShutdownTellsWatchersToComeAgain) {
  const v1::SolveJob job = CreateJob();
  grpc::ClientContext context;
  v1::WatchSnapshotsResponse news;
  auto reader = StartToWatch(job, context);
  ASSERT_TRUE(reader->Read(&news));
  coordinator_->Shutdown();
  while (reader->Read(&news)) {
  }
  const grpc::Status status = reader->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(ReasonOf(status), "SHUTTING_DOWN");
}

}  // namespace
}  // namespace lambert
