// A coordinator that starts again on the stores of another.
#include <gtest/gtest.h>

#include "radiosity/core/digest.h"
#include "server/database/open_stores.h"
#include "server/database/sqlite_record_store.h"
#include "server/jobs/journal.h"
#include "tests/service/service_fixture.h"
#include "tests/support/temporary_folder.h"

namespace lambert {
namespace {

class Restart : public ServiceFixture {
 protected:
  void StartOnFolder(server::CoordinatorOptions options = {}) {
    Stop();
    Serve(*server::Coordinator::Start(options, *server::OpenStores({folder_.path(), {}})));
  }
  // Blocks until watchers have the job's first snapshot.
  void WaitForSnapshot(const std::string& job) {
    grpc::ClientContext context;
    v1::WatchSnapshotsRequest watch;
    watch.set_parent(job);
    auto reader = snapshots()->WatchSnapshots(&context, watch);
    v1::WatchSnapshotsResponse news;
    while (reader->Read(&news) && !news.has_snapshot()) {
    }
    context.TryCancel();
  }
  TemporaryFolder folder_;
};

TEST_F(Restart, GoesOnToTheSameBytes) {
  AddWorker();
  const std::string expected = Watch(CreateJob(200'000).name()).payload;
  for (const auto mode : {server::JournalMode::kOff, server::JournalMode::kEvery}) {
    server::CoordinatorOptions options;
    options.journal = mode;
    StartOnFolder(options);
    AddWorker();
    const std::string id = mode == server::JournalMode::kOff ? "off" : "every";
    const v1::SolveJob job = CreateJob(200'000, id);
    WaitForSnapshot(job.name());
    StartOnFolder(options);
    AddWorker();
    const Watched watched = Watch(job.name());
    EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
    EXPECT_EQ(watched.payload, expected);
    StartOnFolder();
    EXPECT_EQ(Watch(job.name()).payload, expected);
  }
}

// Wherever in the pilots, or after them, the first coordinator ends.
TEST_F(Restart, MeshingEndsInTheSameBytes) {
  const auto create = [this](const std::string& id) {
    v1::CreateSolveJobRequest request;
    request.set_scene(CreateJob(1000).scene());
    request.set_solve_job_id(id);
    request.mutable_spec()->set_max_ray_count(100'000);
    request.mutable_spec()->mutable_patch()->set_adapt_patch_count(500);
    v1::SolveJob job;
    grpc::ClientContext context;
    EXPECT_TRUE(jobs()->CreateSolveJob(&context, request, &job).ok());
    return job.name();
  };
  AddWorker();
  const Watched calm = Watch(create("calm"));
  for (int steps : {1, 16}) {
    server::CoordinatorOptions options;
    options.journal = server::JournalMode::kEvery;
    StartOnFolder(options);
    AddWorker();
    const std::string job = create("restarted-" + std::to_string(steps));
    grpc::ClientContext context;
    v1::WatchSnapshotsRequest watch;
    watch.set_parent(job);
    auto reader = snapshots()->WatchSnapshots(&context, watch);
    v1::WatchSnapshotsResponse news;
    for (int seen = 0; seen < steps && reader->Read(&news) && !news.has_snapshot();) {
      seen += news.progress().pilot() > 0;
    }
    context.TryCancel();
    StartOnFolder(options);
    AddWorker();
    const Watched watched = Watch(job);
    EXPECT_EQ(watched.ended.patch_set_digest().sha256(), calm.ended.patch_set_digest().sha256());
    EXPECT_EQ(watched.payload, calm.payload);
    EXPECT_EQ(watched.ended.meshing().pilot_ray_count(), calm.ended.meshing().pilot_ray_count());
  }
}

TEST_F(Restart, DropsBlobsThatNobodyNeedsOnceTheyAreOld) {
  StartOnFolder();
  AddWorker();
  const v1::SolveJob ended = Watch(CreateJob().name()).ended;
  const std::string orphan = Sha256Hex(std::string("orphan"));
  ASSERT_TRUE(coordinator_->blobs().Put(orphan, "orphan").ok());
  StartOnFolder();
  EXPECT_TRUE(coordinator_->blobs().Has(orphan));  // may be an upload, of a scene to come
  server::CoordinatorOptions options;
  options.uploads.idle = {};
  StartOnFolder(options);
  EXPECT_FALSE(coordinator_->blobs().Has(orphan));
  EXPECT_TRUE(coordinator_->blobs().Has(ended.patch_set_digest().sha256()));
  EXPECT_TRUE(coordinator_->blobs().Has(ended.latest_snapshot().payload_digest().sha256()));
}

TEST_F(Restart, FindsNothingOfAJobThatWasDeleted) {
  StartOnFolder();
  AddWorker();
  const std::string job = Watch(CreateJob(1000, "a").name()).ended.name();
  Stop();
  // As where a full disk kept the job's end from being written.
  ASSERT_TRUE((*server::OpenSqliteRecordStore(folder_.path() + "/lambert.db"))
                  ->Commit({{server::kResumePoints, "a", ""}})
                  .ok());
  StartOnFolder();
  v1::DeleteSolveJobRequest request;
  request.set_name(job);
  google::protobuf::Empty empty;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->DeleteSolveJob(&context, request, &empty).ok());
  Stop();
  auto records = *server::OpenSqliteRecordStore(folder_.path() + "/lambert.db");
  for (const char* kind : {"jobs", "snapshots", "resume"}) {
    EXPECT_TRUE(records->LoadAll(kind)->empty()) << kind;
  }
}

TEST_F(Restart, EndsWithoutHarmWhereAnotherHasTakenOver) {
  absl::Notification lost;
  absl::Status why;
  server::CoordinatorOptions options;
  options.on_stores_lost = [&](const absl::Status& status) {
    why = status;
    lost.Notify();
  };
  StartOnFolder(options);
  const v1::SolveJob job = CreateJob(200'000);
  auto successor = *server::OpenSqliteRecordStore(folder_.path() + "/lambert.db");
  lost.WaitForNotification();
  EXPECT_NE(why.message().find("another server has taken over"), std::string::npos);
  v1::SolveJob record;
  ASSERT_TRUE(record.ParseFromString(successor->LoadAll("jobs")->begin()->second));
  EXPECT_EQ(record.name(), job.name());
  EXPECT_FALSE(record.has_error());
}

}  // namespace
}  // namespace lambert
