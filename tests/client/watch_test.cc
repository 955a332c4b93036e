#include "client/watch.h"

#include <functional>
#include <vector>

#include "gtest/gtest.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "tests/client/fake_server.h"

namespace lambert::client {
namespace {

using News = v1::WatchSnapshotsResponse;

// Plays one scripted stream after the other.
class FakeSnapshots : public v1::SnapshotService::Service {
 public:
  struct Stream {
    std::vector<News> news;
    grpc::Status end = grpc::Status::OK;
  };
  grpc::Status WatchSnapshots(grpc::ServerContext*, const v1::WatchSnapshotsRequest* request,
                              grpc::ServerWriter<News>* writer) override {
    requests.push_back(*request);
    if (requests.size() > streams.size()) return {grpc::StatusCode::NOT_FOUND, "no such job"};
    const Stream& stream = streams[requests.size() - 1];
    for (const News& news : stream.news) writer->Write(news);
    return stream.end;
  }
  std::vector<Stream> streams;
  std::vector<v1::WatchSnapshotsRequest> requests;
};

Solution TwoPatches(double radiosity) {
  Solution solution;
  solution.radiosity_lm_per_m2.assign(2, {radiosity, radiosity, radiosity});
  solution.irradiance_lx.resize(2);
  solution.std_error_lm_per_m2.resize(2);
  solution.hits.resize(2);
  return solution;
}

std::string Payload(int64_t version) { return EncodeSolution(TwoPatches(1.0 * version)); }

News SnapshotNews(int64_t version) {
  News news;
  news.mutable_snapshot()->set_version(version);
  const std::string payload = Payload(version);
  news.mutable_snapshot()->mutable_payload_digest()->set_sha256(Sha256Hex(payload));
  news.mutable_snapshot()->mutable_payload_digest()->set_size_bytes(payload.size());
  return news;
}

News Chunk(const std::string& bytes) {
  News news;
  news.set_payload_chunk(bytes);
  return news;
}

News ProgressNews(int64_t rays) {
  News news;
  news.mutable_progress()->set_ray_count(rays);
  return news;
}

News EndedNews() {
  News news;
  news.mutable_job_ended()->set_name("solveJobs/a");
  news.mutable_job_ended()->set_state(v1::SolveJob::STATE_SUCCEEDED);
  return news;
}

const grpc::Status kBroken(grpc::StatusCode::UNAVAILABLE, "broken");
const grpc::Status kCutOff(grpc::StatusCode::CANCELLED, "the server goes");

class WatchTest : public testing::Test {
 protected:
  absl::StatusOr<Job> Watch(bool with_solutions = false) {
    WatchOptions options;
    options.with_solutions = with_solutions;
    options.on_progress = [this](const Progress& progress) { rays_.push_back(progress.rays); };
    options.on_snapshot = [this](const Snapshot& snapshot) {
      versions_.push_back(snapshot.version);
      if (snapshot.solution) {
        radiosity_.push_back(snapshot.solution->radiosity_lm_per_m2.at(1).g);
      }
      return answer_;
    };
    return WatchJob(*stub_, noted_.caller, "solveJobs/a", options);
  }
  FakeSnapshots fake_;
  FakeServer server_{&fake_};
  NotedCaller noted_;
  std::unique_ptr<v1::SnapshotService::Stub> stub_ =
      v1::SnapshotService::NewStub(server_.channel());
  std::vector<int64_t> rays_, versions_;
  std::vector<double> radiosity_;
  absl::Status answer_;
};

TEST_F(WatchTest, NewsComeInOrderUntilTheJobHasEnded) {
  fake_.streams = {{{ProgressNews(10), SnapshotNews(1), ProgressNews(20), EndedNews()}}};
  const auto job = Watch();
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(job->state, JobState::kSucceeded);
  EXPECT_EQ(rays_, (std::vector<int64_t>{10, 20}));
  EXPECT_EQ(versions_, (std::vector<int64_t>{1}));
  EXPECT_EQ(fake_.requests[0].view(), v1::SNAPSHOT_VIEW_BASIC);
}

TEST_F(WatchTest, SolutionsArePutTogetherFromTheirChunks) {
  const std::string payload = Payload(5);
  fake_.streams = {
      {{SnapshotNews(5), Chunk(payload.substr(0, 20)), Chunk(payload.substr(20)), EndedNews()}}};
  ASSERT_TRUE(Watch(true).ok());
  EXPECT_EQ(radiosity_, std::vector<double>{5});
  EXPECT_EQ(fake_.requests[0].view(), v1::SNAPSHOT_VIEW_FULL);
}

TEST_F(WatchTest, ABrokenStreamIsResumedAfterTheLastWholeSnapshot) {
  const std::string payload = Payload(2);
  fake_.streams = {
      {{SnapshotNews(1), Chunk(Payload(1)), SnapshotNews(2), Chunk("\1\2\3")}, kBroken},
      {{}, kCutOff},
      {{SnapshotNews(2), Chunk(payload), EndedNews()}}};
  const auto job = Watch(true);
  ASSERT_TRUE(job.ok()) << job.status();
  EXPECT_EQ(versions_, (std::vector<int64_t>{1, 2}));
  ASSERT_EQ(fake_.requests.size(), 3u);
  EXPECT_EQ(fake_.requests[1].last_version(), 1);
  EXPECT_EQ(fake_.requests[2].last_version(), 1);
  ASSERT_EQ(noted_.notices.size(), 2u);
  EXPECT_EQ(noted_.notices[1], "back at test");
}

TEST_F(WatchTest, ASnapshotThatComesTwiceIsToldOnce) {
  fake_.streams = {{{SnapshotNews(3)}, kBroken}, {{SnapshotNews(2), SnapshotNews(4), EndedNews()}}};
  ASSERT_TRUE(Watch().ok());
  EXPECT_EQ(versions_, (std::vector<int64_t>{3, 4}));
}

TEST_F(WatchTest, BytesWithAnotherDigestEndTheWatch) {
  std::string payload = Payload(1);
  payload[30] ^= 1;
  fake_.streams = {{{SnapshotNews(1), Chunk(payload), EndedNews()}}};
  EXPECT_EQ(Watch(true).status().code(), absl::StatusCode::kDataLoss);
  EXPECT_TRUE(versions_.empty());
}

TEST_F(WatchTest, AWatcherThatRefusesASnapshotEndsTheWatchWithItsReason) {
  answer_ = absl::ResourceExhaustedError("disk full");
  fake_.streams = {{{SnapshotNews(1), SnapshotNews(2), EndedNews()}}};
  EXPECT_EQ(Watch().status(), answer_);
  EXPECT_EQ(versions_, std::vector<int64_t>{1});
}

TEST_F(WatchTest, AJobThatTheServerForgotIsAnError) {
  fake_.streams = {{{SnapshotNews(1)}, kBroken}};
  EXPECT_EQ(Watch().status().code(), absl::StatusCode::kNotFound);
}

}  // namespace
}  // namespace lambert::client
