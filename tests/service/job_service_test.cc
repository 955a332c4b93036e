#include "lambert/v1/farm_service.grpc.pb.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

using JobService = ServiceFixture;

TEST_F(JobService, SolvesAJobFromUploadToTheLastSnapshot) {
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

TEST_F(JobService, GivesTheBytesOfTheLoopWithoutANetwork) {
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

TEST_F(JobService, TheSameRequestMakesOneJob) {
  EXPECT_EQ(CreateJob(1000, "one").name(), "solveJobs/one");
  EXPECT_EQ(CreateJob(1000, "one").name(), "solveJobs/one");
  EXPECT_EQ(coordinator_->jobs().All().size(), 1u);
  v1::CreateSolveJobRequest request;
  request.set_scene(CreateJob(1000, "one").scene());
  request.set_solve_job_id("one");
  v1::SolveJob job;
  grpc::ClientContext taken;
  EXPECT_EQ(ReasonOf(jobs()->CreateSolveJob(&taken, request, &job)), "JOB_ID_TAKEN");
  request.clear_solve_job_id();
  request.set_request_id("0b8bcb3e");
  grpc::ClientContext first, second;
  ASSERT_TRUE(jobs()->CreateSolveJob(&first, request, &job).ok());
  const std::string name = job.name();
  ASSERT_TRUE(jobs()->CreateSolveJob(&second, request, &job).ok());
  EXPECT_EQ(job.name(), name);
}

TEST_F(JobService, RefusesBadJobsByName) {
  v1::Scene scene;
  ASSERT_TRUE(CreateScene(ToGlb(MakeCornell(1)), &scene).ok());
  auto reason = [&](auto change) {
    v1::CreateSolveJobRequest request;
    request.set_scene(scene.name());
    change(request);
    v1::SolveJob job;
    grpc::ClientContext context;
    return ReasonOf(jobs()->CreateSolveJob(&context, request, &job));
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

TEST_F(JobService, AJobWhosePatchesCannotBeBuiltFailsWithTheReason) {
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

TEST_F(JobService, PlansASceneWithoutSolvingIt) {
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

TEST_F(JobService, ACancelledJobKeepsTheBestSoFar) {
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

TEST_F(JobService, AFullStoreFailsTheJobAndKeepsItsLastSnapshot) {
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

TEST_F(JobService, AQueuedJobIsCancelledAtOnce) {
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

TEST_F(JobService, ADeletedJobTakesItsBlobsAlong) {
  AddWorker();
  const v1::SolveJob job = CreateJob();
  v1::DeleteSolveJobRequest request;
  request.set_name(job.name());
  google::protobuf::Empty empty;
  grpc::ClientContext during, after, gone;
  EXPECT_EQ(ReasonOf(jobs()->DeleteSolveJob(&during, request, &empty)), "JOB_NOT_ENDED");
  const v1::SolveJob ended = Watch(job.name()).ended;
  ASSERT_TRUE(jobs()->DeleteSolveJob(&after, request, &empty).ok());
  EXPECT_FALSE(coordinator_->blobs().Has(ended.patch_set_digest().sha256()));
  EXPECT_FALSE(coordinator_->blobs().Has(ended.latest_snapshot().payload_digest().sha256()));
  EXPECT_EQ(ReasonOf(jobs()->DeleteSolveJob(&gone, request, &empty)), "JOB_NOT_FOUND");
}

TEST_F(JobService, ListsJobsPageByPage) {
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
  EXPECT_EQ(ReasonOf(jobs()->ListSolveJobs(&negative, request, &page)), "FIELD_INVALID");
}

TEST_F(JobService, ListsItsWorkers) {
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

}  // namespace
}  // namespace lambert
