// What one client has, another does not see.
#include <filesystem>
#include <fstream>

#include "server/database/open_stores.h"
#include "tests/service/service_fixture.h"
#include "tests/support/temporary_folder.h"

namespace lambert {
namespace {

using server::Role;

// Calls that bring a token.
class Guest : public ServiceCalls {
 public:
  Guest(server::RpcServer* rpc, const std::string& token) { Connect(Channel(rpc, token)); }
  static std::shared_ptr<grpc::Channel> Channel(server::RpcServer* rpc, const std::string& token) {
    TemporaryFolder folder;
    std::ofstream(folder.path() + "/token") << token;
    const CredentialFiles files{"", "", "", folder.path() + "/token"};
    return grpc::CreateChannel(rpc->address(), *MakeChannelCredentials(rpc->address(), files));
  }

  std::string ReasonOfDownload(const std::string& sha256) {
    v1::DownloadBlobRequest request;
    request.set_sha256(sha256);
    grpc::ClientContext context;
    auto reader = blobs()->DownloadBlob(&context, request);
    v1::DownloadBlobResponse piece;
    while (reader->Read(&piece)) {
    }
    return ReasonOf(reader->Finish());
  }
  bool IsMissing(const std::string& bytes) {
    v1::FindMissingBlobsRequest request;
    *request.add_digests() = DigestOf(bytes);
    v1::FindMissingBlobsResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(blobs()->FindMissingBlobs(&context, request, &response).ok());
    return response.missing_digests_size() == 1;
  }
  v1::BlobUpload GetUpload(const std::string& bytes) {
    v1::GetBlobUploadRequest request;
    *request.mutable_digest() = DigestOf(bytes);
    v1::BlobUpload upload;
    grpc::ClientContext context;
    EXPECT_TRUE(blobs()->GetBlobUpload(&context, request, &upload).ok());
    return upload;
  }
  int CountJobs() {
    v1::ListSolveJobsResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(jobs()->ListSolveJobs(&context, {}, &response).ok());
    return response.solve_jobs_size();
  }
  int CountScenes() {
    v1::ListScenesResponse response;
    grpc::ClientContext context;
    EXPECT_TRUE(scenes()->ListScenes(&context, {}, &response).ok());
    return response.scenes_size();
  }
  template <typename Request, typename Response, typename Call>
  static std::string Try(const Request& request, Response response, Call call) {
    grpc::ClientContext context;
    return ReasonOf(call(&context, request, &response));
  }
};

class Ownership : public ServiceFixture {
 protected:
  Ownership() {
    server::CoordinatorOptions options;
    options.quotas = {.jobs = 2, .watchers = 1};
    Open(options);
  }
  // Closed doors on a coordinator that keeps its data in the folder.
  void Open(server::CoordinatorOptions options) {
    Close();
    options.day = [this] { return day_.load(); };
    coordinator_ =
        *server::Coordinator::Start(options, *server::OpenStores({.data_folder = Data()}));
    closed_ = *server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0", {.tokens = tokens_});
  }
  ~Ownership() override { Close(); }
  void Close() {
    workers_.clear();
    closed_.reset();
    Stop();
  }
  std::string Data() const { return folder_.path() + "/data"; }
  Guest As(const std::string& name, Role role = Role::kClient) {
    return Guest(closed_.get(), *server::AddToken(tokens_, {name, role}));
  }
  void AddFarmWorker() {
    worker::WorkerOptions options;
    options.worker_id = "w";
    workers_.push_back(std::make_unique<worker::Worker>(
        Guest::Channel(closed_.get(), *server::AddToken(tokens_, {"farm", Role::kWorker})),
        options));
  }
  int64_t StoredBytes() const {
    int64_t bytes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Data() + "/blobs")) {
      bytes += static_cast<int64_t>(entry.file_size());
    }
    return bytes;
  }

  TemporaryFolder folder_;
  const std::string tokens_ = [this] {
    std::ofstream(folder_.path() + "/tokens");
    return folder_.path() + "/tokens";
  }();
  std::atomic<int64_t> day_{1};
  std::unique_ptr<server::RpcServer> closed_;
};

TEST_F(Ownership, NoCallTellsOfAnothersJob) {
  Guest alice = As("alice"), bob = As("bob");
  AddFarmWorker();
  const v1::SolveJob job = alice.Watch(alice.CreateJob(1000, "mine").name()).ended;
  ASSERT_EQ(job.state(), v1::SolveJob::STATE_SUCCEEDED) << job.error().message();
  EXPECT_EQ(job.name(), "solveJobs/alice.mine");
  EXPECT_EQ(job.owner(), "alice");

  v1::GetSolveJobRequest get;
  get.set_name(job.name());
  v1::CancelSolveJobRequest cancel;
  cancel.set_name(job.name());
  v1::DeleteSolveJobRequest remove;
  remove.set_name(job.name());
  v1::ListSnapshotsRequest history;
  history.set_parent(job.name());
  v1::GetSnapshotRequest latest;
  latest.set_name(job.name() + "/snapshots/latest");
  v1::GetSceneRequest scene;
  scene.set_name(job.scene());
  const auto try_all = [&](Guest& who) {
    const auto jobs = who.jobs();
    const auto snapshots = who.snapshots();
    return std::vector<std::string>{
        Guest::Try(get, v1::SolveJob(),
                   [&](auto* c, auto& q, auto* r) { return jobs->GetSolveJob(c, q, r); }),
        Guest::Try(cancel, v1::SolveJob(),
                   [&](auto* c, auto& q, auto* r) { return jobs->CancelSolveJob(c, q, r); }),
        Guest::Try(history, v1::ListSnapshotsResponse(),
                   [&](auto* c, auto& q, auto* r) { return snapshots->ListSnapshots(c, q, r); }),
        Guest::Try(latest, v1::Snapshot(),
                   [&](auto* c, auto& q, auto* r) { return snapshots->GetSnapshot(c, q, r); }),
        Guest::Try(scene, v1::Scene(),
                   [&](auto* c, auto& q, auto* r) { return who.scenes()->GetScene(c, q, r); }),
        ReasonOf(who.Watch(job.name()).status),
        who.ReasonOfDownload(job.patch_set_digest().sha256()),
        who.ReasonOfDownload(job.latest_snapshot().payload_digest().sha256())};
  };
  const std::vector<std::string> hidden = {"JOB_NOT_FOUND",  "JOB_NOT_FOUND",   "JOB_NOT_FOUND",
                                           "JOB_NOT_FOUND",  "SCENE_NOT_FOUND", "JOB_NOT_FOUND",
                                           "BLOB_NOT_FOUND", "BLOB_NOT_FOUND"};
  EXPECT_EQ(try_all(bob), hidden);
  EXPECT_EQ(try_all(alice), std::vector<std::string>(8));
  Guest root = As("root", Role::kAdmin);
  EXPECT_EQ(try_all(root), std::vector<std::string>(8));
  EXPECT_EQ(bob.CountJobs() + bob.CountScenes(), 0);
  EXPECT_EQ(root.CountJobs() + root.CountScenes(), 2);
  const auto erase = [&](Guest& who) {
    return Guest::Try(remove, google::protobuf::Empty(), [&](auto* c, auto& q, auto* r) {
      return who.jobs()->DeleteSolveJob(c, q, r);
    });
  };
  EXPECT_EQ(erase(bob), "JOB_NOT_FOUND");
  // The same name, chosen by another, is another job.
  EXPECT_EQ(bob.CreateJob(2000, "mine").name(), "solveJobs/bob.mine");
  EXPECT_EQ(erase(alice), "");
  EXPECT_EQ(alice.CountJobs(), 0);
}

TEST_F(Ownership, ADigestIsNoKey) {
  Guest alice = As("alice"), bob = As("bob");
  const std::string bytes = "what alice has";
  ASSERT_TRUE(alice.Upload(DigestOf(bytes), bytes.substr(0, 5)).ok());
  EXPECT_EQ(bob.GetUpload(bytes).committed_size_bytes(), 0);
  ASSERT_TRUE(alice.Upload(DigestOf(bytes), bytes.substr(5), 5).ok());
  EXPECT_FALSE(alice.IsMissing(bytes));
  EXPECT_TRUE(bob.IsMissing(bytes));
  EXPECT_FALSE(bob.GetUpload(bytes).complete());
  EXPECT_EQ(bob.ReasonOfDownload(Sha256Hex(bytes)), "BLOB_NOT_FOUND");
  // Who names the digest and sends other bytes, or few, or none, gets nothing.
  EXPECT_EQ(ReasonOf(bob.Upload(DigestOf(bytes), "what malice has")), "OFFSET_MISMATCH");
  EXPECT_EQ(ReasonOf(bob.Upload(DigestOf(bytes), "what mal'has!!")), "DIGEST_MISMATCH");
  EXPECT_TRUE(bob.Upload(DigestOf(bytes), "").ok());
  EXPECT_EQ(bob.ReasonOfDownload(Sha256Hex(bytes)), "BLOB_NOT_FOUND");
  EXPECT_EQ(alice.ReasonOfDownload(Sha256Hex(bytes)), "");
  ASSERT_TRUE(bob.Upload(DigestOf(bytes), bytes).ok());
  EXPECT_EQ(bob.ReasonOfDownload(Sha256Hex(bytes)), "");
  // A scene of alice's that goes does not take along what bob sent.
  v1::Scene scene;
  EXPECT_EQ(ReasonOf(alice.CreateScene(bytes, &scene)), "SCENE_INVALID");
  EXPECT_EQ(alice.ReasonOfDownload(Sha256Hex(bytes)), "BLOB_NOT_FOUND");
  EXPECT_EQ(bob.ReasonOfDownload(Sha256Hex(bytes)), "");
}

TEST_F(Ownership, WorkersReadPatchSetsOfRunningJobsAlone) {
  Guest alice = As("alice"), farm = As("farm", Role::kWorker);
  const v1::SolveJob job = alice.CreateJob(1000);
  AddFarmWorker();
  const v1::SolveJob ended = alice.Watch(job.name()).ended;  // so the worker could read it
  EXPECT_EQ(ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(farm.ReasonOfDownload(ended.patch_set_digest().sha256()), "BLOB_NOT_FOUND");
  EXPECT_EQ(farm.ReasonOfDownload(ended.latest_snapshot().payload_digest().sha256()),
            "BLOB_NOT_FOUND");
  EXPECT_EQ(farm.ReasonOfDownload(Sha256Hex(ToGlb(MakeCornell(2)))), "BLOB_NOT_FOUND");
}

TEST_F(Ownership, ADeletedJobTakesItsBytesAlong) {
  Guest alice = As("alice");
  AddFarmWorker();
  const std::string job = alice.CreateJob(1000).name();
  ASSERT_TRUE(alice.Watch(job).status.ok());
  const int64_t before = StoredBytes();
  v1::DeleteSolveJobRequest remove;
  remove.set_name(job);
  google::protobuf::Empty empty;
  grpc::ClientContext first, second;
  ASSERT_TRUE(alice.jobs()->DeleteSolveJob(&first, remove, &empty).ok());
  EXPECT_LT(StoredBytes(), before);
  v1::ListScenesResponse left;
  ASSERT_TRUE(alice.scenes()->ListScenes(&second, {}, &left).ok());
  v1::DeleteSceneRequest scene;
  scene.set_name(left.scenes(0).name());
  grpc::ClientContext third;
  ASSERT_TRUE(alice.scenes()->DeleteScene(&third, scene, &empty).ok());
  EXPECT_EQ(StoredBytes(), 0);
}

TEST_F(Ownership, OutlastsARestart) {
  {
    Guest alice = As("alice");
    alice.CreateJob(1000, "kept");
  }
  Open({});
  Guest alice = As("alice"), bob = As("bob");
  EXPECT_EQ(alice.CountJobs(), 1);
  EXPECT_EQ(alice.CountScenes(), 1);
  EXPECT_EQ(bob.CountJobs() + bob.CountScenes(), 0);
  AddFarmWorker();
  EXPECT_EQ(alice.Watch("solveJobs/alice.kept").ended.state(), v1::SolveJob::STATE_SUCCEEDED);
}

TEST_F(Ownership, QuotasAreOfEachClient) {
  Guest alice = As("alice"), bob = As("bob");
  const v1::SolveJob first = alice.CreateJob(1000), second = alice.CreateJob(2000);
  v1::CreateSolveJobRequest third;
  third.set_scene(first.scene());
  third.mutable_spec()->set_max_ray_count(3000);
  v1::SolveJob job;
  grpc::ClientContext context;
  const grpc::Status status = alice.jobs()->CreateSolveJob(&context, third, &job);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(ReasonOf(status), "QUOTA_EXCEEDED");
  const auto info = ErrorInfoOf(status);
  EXPECT_EQ(info.metadata().at("limit"), "2");
  EXPECT_EQ(info.metadata().at("used"), "2");
  EXPECT_EQ(info.metadata().at("limited"), "jobs that have not ended");
  EXPECT_NE(bob.CreateJob(1000).name(), "");
  // One watcher each.
  grpc::ClientContext held;
  v1::WatchSnapshotsRequest watch;
  watch.set_parent(first.name());
  auto reader = alice.snapshots()->WatchSnapshots(&held, watch);
  v1::WatchSnapshotsResponse news;
  ASSERT_TRUE(reader->Read(&news));
  EXPECT_EQ(ReasonOf(alice.Watch(first.name()).status), "TOO_MANY_WATCHERS");
  held.TryCancel();
  reader->Finish();
}

TEST_F(Ownership, StoredBytesAreLimited) {
  server::CoordinatorOptions options;
  options.quotas.stored_bytes = 1000;
  Open(options);
  Guest alice = As("alice"), bob = As("bob");
  const std::string bytes(600, 'a'), more(600, 'b');
  ASSERT_TRUE(alice.Upload(DigestOf(bytes), bytes).ok());
  ASSERT_TRUE(alice.Upload(DigestOf(bytes), bytes).ok()) << "is there already";
  const grpc::Status status = alice.Upload(DigestOf(more), more);
  EXPECT_EQ(ReasonOf(status), "QUOTA_EXCEEDED");
  EXPECT_EQ(ErrorInfoOf(status).metadata().at("used"), "600");
  EXPECT_TRUE(bob.Upload(DigestOf(bytes), bytes).ok());
}

TEST_F(Ownership, RaysOfADayAreLimited) {
  server::CoordinatorOptions options;
  options.quotas.rays_per_day = 50'000;
  Open(options);
  Guest alice = As("alice");
  AddFarmWorker();
  const v1::SolveJob job = alice.Watch(alice.CreateJob(int64_t{1} << 40).name()).ended;
  EXPECT_EQ(job.state(), v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(job.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "QUOTA_EXCEEDED");
  EXPECT_EQ(info.metadata().at("limited"), "rays a day");
  EXPECT_GT(job.latest_snapshot().version(), 0) << "the result so far stays";
  v1::CreateSolveJobRequest request;
  request.set_scene(job.scene());
  request.mutable_spec()->set_max_ray_count(100);
  v1::SolveJob next;
  grpc::ClientContext today, tomorrow;
  EXPECT_EQ(ReasonOf(alice.jobs()->CreateSolveJob(&today, request, &next)), "QUOTA_EXCEEDED");
  Open(options);  // what was used outlasts a restart
  Guest again = As("alice");
  grpc::ClientContext later;
  EXPECT_EQ(ReasonOf(again.jobs()->CreateSolveJob(&later, request, &next)), "QUOTA_EXCEEDED");
  ++day_;
  EXPECT_TRUE(again.jobs()->CreateSolveJob(&tomorrow, request, &next).ok());
}

}  // namespace
}  // namespace lambert
