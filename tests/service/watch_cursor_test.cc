#include "server/stream/watch_cursor.h"

#include <gtest/gtest.h>

#include "radiosity/core/digest.h"

namespace lambert::server {
namespace {

class WatchCursorTest : public testing::Test {
 protected:
  WatchCursorTest() {
    v1::SolveJob record;
    record.set_name("solveJobs/j");
    record.set_state(v1::SolveJob::STATE_RUNNING);
    job_ = std::make_shared<Job>(record);
  }
  void Publish(int64_t version, const std::string& payload) {
    v1::Snapshot snapshot;
    snapshot.set_version(version);
    snapshot.mutable_payload_digest()->set_sha256(Sha256Hex(payload));
    snapshot.mutable_payload_digest()->set_size_bytes(static_cast<int64_t>(payload.size()));
    ASSERT_TRUE(blobs_->Put(Sha256Hex(payload), payload).ok());
    job_->AddSnapshot(snapshot);
  }
  void End() {
    job_->Update([](v1::SolveJob& record) { record.set_state(v1::SolveJob::STATE_SUCCEEDED); });
  }
  WatchCursor Watch(int64_t last_version, v1::SnapshotView view = v1::SNAPSHOT_VIEW_BASIC) {
    v1::WatchSnapshotsRequest request;
    request.set_last_version(last_version);
    request.set_view(view);
    WatchCursor cursor(job_, blobs_.get(), request);
    if (auto progress = cursor.Next()) first_ = *progress;
    return cursor;
  }

  std::unique_ptr<BlobStore> blobs_ = MakeMemoryBlobStore(1 << 24);
  std::shared_ptr<Job> job_;
  v1::WatchSnapshotsResponse first_;
};

TEST_F(WatchCursorTest, SaysAtOnceWhereTheJobStands) {
  WatchCursor cursor = Watch(0);
  EXPECT_TRUE(first_.has_progress());
  EXPECT_FALSE(cursor.Next().has_value());
}

TEST_F(WatchCursorTest, ASlowWatcherGetsTheNewestAndMissesThoseBetween) {
  WatchCursor cursor = Watch(0);
  for (int64_t version : {1, 2, 3}) Publish(version, std::to_string(version));
  EXPECT_EQ(cursor.Next()->snapshot().version(), 3);
  EXPECT_FALSE(cursor.Next().has_value());
}

TEST_F(WatchCursorTest, NewsDuringAPayloadWaitsUntilThePayloadIsWhole) {
  WatchCursor cursor = Watch(0, v1::SNAPSHOT_VIEW_FULL);
  const std::string large(3 << 20, 'x');
  Publish(1, large);
  EXPECT_EQ(cursor.Next()->snapshot().version(), 1);
  std::string received = cursor.Next()->payload_chunk();
  EXPECT_EQ(received.size(), size_t{1} << 20);
  Publish(2, "two");
  blobs_->Delete(Sha256Hex(large));  // as the runner does with old payloads
  Publish(3, "three");
  received += cursor.Next()->payload_chunk();
  received += cursor.Next()->payload_chunk();
  EXPECT_EQ(received, large);
  EXPECT_EQ(cursor.Next()->snapshot().version(), 3);
  EXPECT_EQ(cursor.Next()->payload_chunk(), "three");
}

TEST_F(WatchCursorTest, AResumedWatcherGetsOnlyWhatItLacks) {
  Publish(4, "four");
  WatchCursor cursor = Watch(4);
  EXPECT_TRUE(first_.has_progress());
  Publish(5, "five");
  EXPECT_EQ(cursor.Next()->snapshot().version(), 5);
}

TEST_F(WatchCursorTest, TheLastSnapshotComesBeforeTheEnd) {
  WatchCursor cursor = Watch(0);
  Publish(1, "one");
  End();
  EXPECT_EQ(cursor.Next()->snapshot().version(), 1);
  EXPECT_EQ(cursor.Next()->job_ended().state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_TRUE(cursor.done());
  EXPECT_FALSE(cursor.Next().has_value());
}

TEST_F(WatchCursorTest, RepeatedProgressShowsThatTheJobIsAlive) {
  WatchCursor cursor = Watch(0);
  EXPECT_FALSE(cursor.Next().has_value());
  job_->RepeatProgress();
  EXPECT_TRUE(cursor.Next()->has_progress());
}

}  // namespace
}  // namespace lambert::server
