#include <thread>

#include "lambert/v1/farm_service.grpc.pb.h"
#include "lambert/worker/v1/worker_service.grpc.pb.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/service/service_fixture.h"
#include "tests/service/temporary_folder.h"

namespace lambert {
namespace {

using Service = ServiceFixture;

std::string Reason(const grpc::Status& status) { return ErrorInfoOf(status).reason(); }

TEST_F(Service, SolvesAJobFromUploadToTheLastSnapshot) {
  AddWorker();
  AddWorker();
  const Watched watched = Watch(CreateJob().name());
  EXPECT_TRUE(watched.status.ok());
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(watched.ended.stop_reason(), v1::SolveJob::STOP_REASON_RAYS_SPENT);
  EXPECT_TRUE(watched.ended.reached_goal());
  EXPECT_EQ(watched.ended.plan().patch_count(), 128);
  ASSERT_FALSE(watched.snapshots.empty());
  EXPECT_EQ(watched.snapshots.back().payload_digest().sha256(), Sha256Hex(watched.payload));
  EXPECT_TRUE(DecodeSolution(watched.payload).ok());
}

TEST_F(Service, GivesTheBytesOfTheLoopWithoutANetwork) {
  for (int i = 0; i < 3; ++i) AddWorker();
  const Watched watched = Watch(CreateJob(50'000).name());
  const PatchSet patches = *BuildPatches(*LoadGltf({"room.glb", ToGlb(MakeCornell(2)), {}}), {});
  SolveOptions options;
  options.shoot.method = Method::kAuto;
  options.max_rays = 50'000;
  const Plan plan = MakePlan(patches, options);
  auto shared = std::make_shared<const PatchSet>(patches);
  SerialExecutor executor(*Shooter::Create(shared, plan.options.shoot));
  Solver solver(shared, plan.options, [] { return 0.0; });
  while (solver.stop_reason() == StopReason::kNone) {
    ASSERT_TRUE(solver.RunPass(executor, nullptr).ok());
  }
  EXPECT_EQ(watched.payload, EncodeSolution(*solver.MakeSnapshot().solution));
}

TEST_F(Service, AnUploadGoesOnWhereItBrokeOff) {
  const std::string bytes(3'000'000, 'x');
  const v1::Digest digest = DigestOf(bytes);
  EXPECT_TRUE(Upload(digest, bytes.substr(0, 1'000'000)).ok());
  v1::GetBlobUploadRequest request;
  *request.mutable_digest() = digest;
  v1::BlobUpload upload;
  grpc::ClientContext before;
  ASSERT_TRUE(blobs()->GetBlobUpload(&before, request, &upload).ok());
  EXPECT_EQ(upload.committed_size_bytes(), 1'000'000);
  EXPECT_FALSE(upload.complete());
  EXPECT_TRUE(Upload(digest, bytes.substr(1'000'000), 1'000'000).ok());
  grpc::ClientContext after;
  ASSERT_TRUE(blobs()->GetBlobUpload(&after, request, &upload).ok());
  EXPECT_TRUE(upload.complete());
}

TEST_F(Service, ADownloadBeginsWhereItIsAskedTo) {
  const std::string bytes = std::string(1'500'000, 'a') + "end";
  ASSERT_TRUE(Upload(DigestOf(bytes), bytes).ok());
  v1::DownloadBlobRequest request;
  request.set_sha256(Sha256Hex(bytes));
  request.set_offset_bytes(1'499'999);
  grpc::ClientContext context;
  auto reader = blobs()->DownloadBlob(&context, request);
  std::string received;
  v1::DownloadBlobResponse piece;
  while (reader->Read(&piece)) received += piece.data();
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(received, "aend");
}

TEST_F(Service, RefusesBadUploadsByName) {
  const std::string bytes = "some bytes";
  v1::Digest digest = DigestOf(bytes);
  EXPECT_EQ(Reason(Upload(digest, "some bytez")), "DIGEST_MISMATCH");
  EXPECT_EQ(Reason(Upload(digest, bytes, 3)), "OFFSET_MISMATCH");
  EXPECT_EQ(ErrorInfoOf(Upload(digest, bytes, 3)).metadata().at("committedSizeBytes"), "0");
  EXPECT_EQ(
      Reason(Upload(DigestOf(std::string(2 << 20, 'x')), std::string(2 << 20, 'x'), 0, 2 << 20)),
      "FIELD_INVALID");
  digest.set_sha256("../jobs/x");
  EXPECT_EQ(Reason(Upload(digest, bytes)), "FIELD_INVALID");
}

TEST_F(Service, FindsMissingBlobsOnce) {
  ASSERT_TRUE(Upload(DigestOf("here"), "here").ok());
  v1::FindMissingBlobsRequest request;
  for (const char* bytes : {"here", "missing", "missing"}) *request.add_digests() = DigestOf(bytes);
  v1::FindMissingBlobsResponse response;
  grpc::ClientContext context;
  ASSERT_TRUE(blobs()->FindMissingBlobs(&context, request, &response).ok());
  ASSERT_EQ(response.missing_digests_size(), 1);
  EXPECT_EQ(response.missing_digests(0).sha256(), DigestOf("missing").sha256());
}

TEST_F(Service, NamesTheBlobsThatASceneLacks) {
  v1::CreateSceneRequest request;
  request.add_files()->set_uri("room.glb");
  *request.mutable_files(0)->mutable_digest() = DigestOf("nowhere");
  v1::Scene scene;
  grpc::ClientContext context;
  const grpc::Status status = scenes()->CreateScene(&context, request, &scene);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(Reason(status), "BLOBS_MISSING");
  google::rpc::Status details;
  ASSERT_TRUE(details.ParseFromString(status.error_details()));
  google::rpc::PreconditionFailure failure;
  ASSERT_TRUE(details.details(1).UnpackTo(&failure));
  EXPECT_EQ(failure.violations(0).type(), "MISSING");
  EXPECT_EQ(failure.violations(0).subject(), "blobs/" + Sha256Hex(std::string("nowhere")) + "/7");
}

TEST_F(Service, ARefusedSceneLeavesNothingBehind) {
  v1::Scene scene;
  const grpc::Status status = CreateScene("this is no scene", &scene);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  const google::rpc::ErrorInfo info = ErrorInfoOf(status);
  EXPECT_EQ(info.reason(), "SCENE_INVALID");
  EXPECT_EQ(info.domain(), "lambert");
  for (const char* key : {"where", "message", "hint"})
    EXPECT_NE(info.metadata().at(key), "") << key;
  EXPECT_FALSE(coordinator_->blobs().Has(Sha256Hex(std::string("this is no scene"))));
  EXPECT_TRUE(coordinator_->scenes().List(0, "")->items.empty());
}

TEST_F(Service, EqualScenesAreOneScene) {
  v1::Scene first, second;
  const std::string glb = ToGlb(MakeCornell(1));
  ASSERT_TRUE(CreateScene(glb, &first).ok());
  ASSERT_TRUE(CreateScene(glb, &second).ok());
  EXPECT_EQ(first.name(), second.name());
  const std::string manifest =
      std::string("room.glb") + '\0' + Sha256Hex(glb) + '\0' + std::to_string(glb.size()) + '\n';
  EXPECT_EQ(first.name(), "scenes/" + Sha256Hex(manifest));
}

TEST_F(Service, ASceneThatIsBeingSolvedIsNotDeleted) {
  const v1::SolveJob job = CreateJob();  // no worker: it does not end
  v1::DeleteSceneRequest request;
  request.set_name(job.scene());
  google::protobuf::Empty empty;
  grpc::ClientContext during, after;
  EXPECT_EQ(Reason(scenes()->DeleteScene(&during, request, &empty)), "SCENE_IN_USE");
  AddWorker();
  Watch(job.name());
  EXPECT_TRUE(scenes()->DeleteScene(&after, request, &empty).ok());
}

TEST_F(Service, TheSameRequestMakesOneJob) {
  EXPECT_EQ(CreateJob(1000, "one").name(), "solveJobs/one");
  EXPECT_EQ(CreateJob(1000, "one").name(), "solveJobs/one");
  EXPECT_EQ(coordinator_->jobs().All().size(), 1u);
  v1::CreateSolveJobRequest request;
  request.set_scene(CreateJob(1000, "one").scene());
  request.set_solve_job_id("one");
  v1::SolveJob job;
  grpc::ClientContext taken;
  EXPECT_EQ(Reason(jobs()->CreateSolveJob(&taken, request, &job)), "JOB_ID_TAKEN");
  request.clear_solve_job_id();
  request.set_request_id("0b8bcb3e");
  grpc::ClientContext first, second;
  ASSERT_TRUE(jobs()->CreateSolveJob(&first, request, &job).ok());
  const std::string name = job.name();
  ASSERT_TRUE(jobs()->CreateSolveJob(&second, request, &job).ok());
  EXPECT_EQ(job.name(), name);
}

TEST_F(Service, RefusesBadJobsByName) {
  v1::Scene scene;
  ASSERT_TRUE(CreateScene(ToGlb(MakeCornell(1)), &scene).ok());
  auto reason = [&](auto change) {
    v1::CreateSolveJobRequest request;
    request.set_scene(scene.name());
    change(request);
    v1::SolveJob job;
    grpc::ClientContext context;
    return Reason(jobs()->CreateSolveJob(&context, request, &job));
  };
  EXPECT_EQ(reason([](auto& r) { r.set_scene("scenes/none"); }), "SCENE_NOT_FOUND");
  EXPECT_EQ(reason([](auto& r) { r.set_solve_job_id("No Id"); }), "FIELD_INVALID");
  EXPECT_EQ(reason([](auto& r) { r.set_request_id(std::string(200, 'x')); }), "FIELD_INVALID");
  EXPECT_EQ(reason([](auto& r) { r.mutable_spec()->set_max_error(-1); }), "FIELD_INVALID");
  EXPECT_EQ(reason([](auto& r) { r.mutable_spec()->mutable_shoot()->set_method("magic"); }),
            "FIELD_INVALID");
  EXPECT_EQ(reason([](auto& r) { r.mutable_spec()->mutable_patch()->set_max_edge_meters(-1); }),
            "FIELD_INVALID");
  EXPECT_TRUE(coordinator_->jobs().All().empty());
}

TEST_F(Service, NamesTheFieldThatIsWrong) {
  v1::ListScenesRequest request;
  request.set_page_size(-1);
  v1::ListScenesResponse response;
  grpc::ClientContext context;
  google::rpc::Status details;
  ASSERT_TRUE(
      details.ParseFromString(scenes()->ListScenes(&context, request, &response).error_details()));
  google::rpc::BadRequest wrong;
  ASSERT_TRUE(details.details(1).UnpackTo(&wrong));
  EXPECT_EQ(wrong.field_violations(0).field(), "page_size");
}

TEST_F(Service, AJobWhosePatchesCannotBeBuiltFailsWithTheReason) {
  v1::Scene scene;
  ASSERT_TRUE(CreateScene(R"({"asset": {"version": "2.0"}})", &scene).ok());
  v1::CreateSolveJobRequest request;
  request.set_scene(scene.name());
  v1::SolveJob job;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->CreateSolveJob(&context, request, &job).ok());
  const Watched watched = Watch(job.name());
  EXPECT_TRUE(watched.status.ok());
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(watched.ended.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "NO_TRIANGLES");
}

TEST_F(Service, PlansASceneWithoutSolvingIt) {
  v1::Scene scene;
  ASSERT_TRUE(CreateScene(ToGlb(MakeCornell(2)), &scene).ok());
  v1::PlanSceneRequest request;
  request.set_scene(scene.name());
  v1::PlanSceneResponse response;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->PlanScene(&context, request, &response).ok());
  EXPECT_EQ(response.plan().patch_count(), 128);
  EXPECT_FALSE(response.plan().spec().shoot().method().empty());
  EXPECT_TRUE(coordinator_->jobs().All().empty());
}

TEST_F(Service, ACancelledJobKeepsTheBestSoFar) {
  AddWorker();
  const v1::SolveJob job = CreateJob(int64_t{1} << 50);
  grpc::ClientContext watching;
  v1::WatchSnapshotsRequest watch;
  watch.set_parent(job.name());
  auto reader = snapshots()->WatchSnapshots(&watching, watch);
  v1::WatchSnapshotsResponse news;
  while (reader->Read(&news) && !news.has_snapshot()) {
  }
  v1::CancelSolveJobRequest request;
  request.set_name(job.name());
  v1::SolveJob cancelled;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->CancelSolveJob(&context, request, &cancelled).ok());
  while (reader->Read(&news)) {
  }
  EXPECT_TRUE(reader->Finish().ok());
  EXPECT_EQ(news.job_ended().state(), v1::SolveJob::STATE_CANCELLED);
  EXPECT_GE(news.job_ended().latest_snapshot().version(), 1);
  EXPECT_TRUE(
      coordinator_->blobs().Has(news.job_ended().latest_snapshot().payload_digest().sha256()));
}

TEST_F(Service, AFullStoreFailsTheJobAndKeepsItsLastSnapshot) {
  AddWorker();
  const Watched roomy = Watch(CreateJob(1'000'000).name());
  ASSERT_GE(roomy.ended.latest_snapshot().version(), 2);
  server::CoordinatorOptions
      options;  // room for one snapshot beside scene and patches, not for two
  options.max_store_bytes = static_cast<int64_t>(ToGlb(MakeCornell(2)).size()) +
                            roomy.ended.patch_set_digest().size_bytes() +
                            static_cast<int64_t>(roomy.payload.size()) * 3 / 2;
  Start(options);
  AddWorker();
  const Watched watched = Watch(CreateJob(1'000'000).name());
  ASSERT_EQ(watched.ended.state(), v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(watched.ended.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "STORE_FULL");
  EXPECT_EQ(watched.ended.latest_snapshot().version(), 1);
  EXPECT_TRUE(DecodeSolution(watched.payload).ok());
}

TEST_F(Service, AQueuedJobIsCancelledAtOnce) {
  server::CoordinatorOptions options;
  options.max_running_jobs = 1;
  Start(options);
  CreateJob(1000, "runs");
  CreateJob(1000, "waits");
  v1::CancelSolveJobRequest request;
  request.set_name("solveJobs/waits");
  v1::SolveJob job;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->CancelSolveJob(&context, request, &job).ok());
  EXPECT_EQ(job.state(), v1::SolveJob::STATE_CANCELLED);
  EXPECT_EQ(Watch("solveJobs/waits").ended.state(), v1::SolveJob::STATE_CANCELLED);
}

TEST_F(Service, ADeletedJobTakesItsBlobsAlong) {
  AddWorker();
  const v1::SolveJob job = CreateJob();
  v1::DeleteSolveJobRequest request;
  request.set_name(job.name());
  google::protobuf::Empty empty;
  grpc::ClientContext during, after, gone;
  EXPECT_EQ(Reason(jobs()->DeleteSolveJob(&during, request, &empty)), "JOB_NOT_ENDED");
  const v1::SolveJob ended = Watch(job.name()).ended;
  ASSERT_TRUE(jobs()->DeleteSolveJob(&after, request, &empty).ok());
  EXPECT_FALSE(coordinator_->blobs().Has(ended.patch_set_digest().sha256()));
  EXPECT_FALSE(coordinator_->blobs().Has(ended.latest_snapshot().payload_digest().sha256()));
  EXPECT_EQ(Reason(jobs()->DeleteSolveJob(&gone, request, &empty)), "JOB_NOT_FOUND");
}

TEST_F(Service, ListsJobsPageByPage) {
  for (const char* id : {"a", "b", "c"}) CreateJob(1000, id);
  v1::ListSolveJobsRequest request;
  request.set_page_size(2);
  v1::ListSolveJobsResponse page;
  grpc::ClientContext first, second, negative;
  ASSERT_TRUE(jobs()->ListSolveJobs(&first, request, &page).ok());
  ASSERT_EQ(page.solve_jobs_size(), 2);
  request.set_page_token(page.next_page_token());
  page.Clear();
  ASSERT_TRUE(jobs()->ListSolveJobs(&second, request, &page).ok());
  ASSERT_EQ(page.solve_jobs_size(), 1);
  EXPECT_EQ(page.solve_jobs(0).name(), "solveJobs/c");
  EXPECT_EQ(page.next_page_token(), "");
  request.set_page_size(-1);
  EXPECT_EQ(Reason(jobs()->ListSolveJobs(&negative, request, &page)), "FIELD_INVALID");
}

TEST_F(Service, AWatcherResumesAfterTheVersionThatItHas) {
  AddWorker();
  const v1::SolveJob job = CreateJob();
  const int64_t last = Watch(job.name()).snapshots.back().version();
  EXPECT_TRUE(Watch(job.name(), last).snapshots.empty());
  const Watched again = Watch(job.name(), last - 1);
  ASSERT_EQ(again.snapshots.size(), 1u);
  EXPECT_EQ(again.snapshots[0].version(), last);
  EXPECT_FALSE(again.payload.empty());
}

TEST_F(Service, DescribesTheSnapshotsOfAJob) {
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
  EXPECT_EQ(Reason(snapshots()->GetSnapshot(&missing, get, &snapshot)), "SNAPSHOT_NOT_FOUND");
  get.set_name("solveJobs/none/snapshots/1");
  EXPECT_EQ(Reason(snapshots()->GetSnapshot(&nowhere, get, &snapshot)), "JOB_NOT_FOUND");
}

TEST_F(Service, WatchingNoJobIsAnError) {
  EXPECT_EQ(Reason(Watch("solveJobs/none").status), "JOB_NOT_FOUND");
}

TEST_F(Service, AWatcherThatGoesAwayHoldsNothingUp) {
  const v1::SolveJob job = CreateJob();
  grpc::ClientContext context;
  v1::WatchSnapshotsRequest watch;
  watch.set_parent(job.name());
  auto reader = snapshots()->WatchSnapshots(&context, watch);
  v1::WatchSnapshotsResponse news;
  ASSERT_TRUE(reader->Read(&news));
  context.TryCancel();
  EXPECT_EQ(reader->Finish().error_code(), grpc::StatusCode::CANCELLED);
  AddWorker();
  EXPECT_EQ(Watch(job.name()).ended.state(), v1::SolveJob::STATE_SUCCEEDED);
}

TEST_F(Service, ShutdownTellsWatchersToComeAgain) {
  const v1::SolveJob job = CreateJob();
  grpc::ClientContext context;
  v1::WatchSnapshotsRequest watch;
  watch.set_parent(job.name());
  auto reader = snapshots()->WatchSnapshots(&context, watch);
  v1::WatchSnapshotsResponse news;
  ASSERT_TRUE(reader->Read(&news));
  coordinator_->Shutdown();
  while (reader->Read(&news)) {
  }
  const grpc::Status status = reader->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(Reason(status), "SHUTTING_DOWN");
}

TEST_F(Service, ListsItsWorkers) {
  AddWorker(Shooter::Create, 3);
  Watch(CreateJob().name());
  v1::ListWorkersResponse response;
  grpc::ClientContext context;
  ASSERT_TRUE(v1::FarmService::NewStub(channel())->ListWorkers(&context, {}, &response).ok());
  ASSERT_EQ(response.workers_size(), 1);
  EXPECT_EQ(response.workers(0).name(), "workers/worker-0");
  EXPECT_EQ(response.workers(0).slot_count(), 3);
  EXPECT_GT(response.workers(0).finished_unit_count(), 0);
}

TEST_F(Service, ARestartedServerGoesOnFromTheLastCheckpointToTheSameBytes) {
  AddWorker();
  const std::string expected = Watch(CreateJob(200'000).name()).payload;
  TemporaryFolder folder;
  server::CoordinatorOptions options;
  options.data_folder = folder.path();
  Start(options);
  AddWorker();
  const v1::SolveJob job = CreateJob(200'000);
  {
    grpc::ClientContext context;
    v1::WatchSnapshotsRequest watch;
    watch.set_parent(job.name());
    auto reader = snapshots()->WatchSnapshots(&context, watch);
    v1::WatchSnapshotsResponse news;
    while (reader->Read(&news) && !news.has_snapshot()) {
    }
    context.TryCancel();
  }
  Start(options);
  AddWorker();
  const Watched watched = Watch(job.name());
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(watched.payload, expected);
  Start(options);
  EXPECT_EQ(Watch(job.name()).payload, expected);
}

}  // namespace
}  // namespace lambert
