#include "client/client.h"

#include <random>
#include <utility>

#include "client/blobs.h"
#include "client/caller.h"
#include "client/convert.h"
#include "client/gather.h"
#include "client/watch.h"
#include "fmt/format.h"
#include "grpcpp/channel.h"
#include "lambert/v1/blob_service.grpc.pb.h"
#include "lambert/v1/farm_service.grpc.pb.h"
#include "lambert/v1/gather_service.grpc.pb.h"
#include "lambert/v1/scene_service.grpc.pb.h"
#include "lambert/v1/snapshot_service.grpc.pb.h"
#include "lambert/v1/solve_job_service.grpc.pb.h"
#include "net/solve_spec.h"
#include "radiosity/core/digest.h"

namespace lambert::client {
namespace {

constexpr std::chrono::duration<double> kReadDeadline{5};
constexpr std::chrono::duration<double> kWriteDeadline{10};
// The server reads the whole scene, or builds its patches, before it answers.
constexpr std::chrono::duration<double> kSceneDeadline{600};
constexpr int kPageSize = 500;

// Chosen once a job, repeated with every attempt to create it.
std::string NewRequestId() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

}  // namespace

struct Client::Stubs {
  Stubs(std::shared_ptr<grpc::Channel> channel, ClientOptions options)
      : caller(options.server, options.patience, options.on_notice),
        blob(v1::BlobService::NewStub(channel)),
        scene(v1::SceneService::NewStub(channel)),
        job(v1::SolveJobService::NewStub(channel)),
        snapshot(v1::SnapshotService::NewStub(channel)),
        gather(v1::GatherService::NewStub(channel)),
        farm(v1::FarmService::NewStub(channel)),
        blobs(blob.get(), &caller) {}

  Caller caller;
  const std::unique_ptr<v1::BlobService::Stub> blob;
  const std::unique_ptr<v1::SceneService::Stub> scene;
  const std::unique_ptr<v1::SolveJobService::Stub> job;
  const std::unique_ptr<v1::SnapshotService::Stub> snapshot;
  const std::unique_ptr<v1::GatherService::Stub> gather;
  const std::unique_ptr<v1::FarmService::Stub> farm;
  Blobs blobs;
};

Client::Client(std::shared_ptr<grpc::Channel> channel, ClientOptions options)
    : stubs_(std::make_unique<Stubs>(std::move(channel), std::move(options))) {}

Client::~Client() = default;

void Client::Abort() { stubs_->caller.Abort(); }

absl::StatusOr<SubmittedScene> Client::SubmitScene(
    const SceneBundle& bundle, const std::function<void(int64_t, int64_t)>& on_upload) {
  v1::CreateSceneRequest request;
  std::vector<const std::string*> files;
  const auto add = [&](const std::string& uri, const std::string& bytes) {
    v1::SceneFile* file = request.add_files();
    file->set_uri(uri);
    file->mutable_digest()->set_sha256(Sha256Hex(bytes));
    file->mutable_digest()->set_size_bytes(static_cast<int64_t>(bytes.size()));
    files.push_back(&bytes);
  };
  add(bundle.main_name, bundle.main_bytes);
  for (const auto& [uri, bytes] : bundle.files) add(uri, bytes);

  absl::Status status = stubs_->blobs.Upload(files, on_upload);
  if (!status.ok()) return status;
  v1::Scene scene;
  status = stubs_->caller.Call(bundle.main_name, kSceneDeadline, [&](auto& context) {
    return stubs_->scene->CreateScene(&context, request, &scene);
  });
  if (!status.ok()) return status;
  SubmittedScene submitted{scene.name(), scene.name().substr(scene.name().find('/') + 1), {}};
  for (const v1::Warning& warning : scene.warnings()) {
    submitted.warnings.push_back({warning.reason(), warning.message()});
  }
  return submitted;
}

absl::StatusOr<PlannedScene> Client::PlanScene(const std::string& scene, const PatchOptions& patch,
                                               const SolveOptions& solve) {
  v1::PlanSceneRequest request;
  request.set_scene(scene);
  *request.mutable_spec() = MakeSpec(patch, solve);
  v1::PlanSceneResponse response;
  absl::Status status = stubs_->caller.Call(scene, kSceneDeadline, [&](auto& context) {
    return stubs_->job->PlanScene(&context, request, &response);
  });
  if (!status.ok()) return status;
  PlannedScene planned{FromProto(response.plan()), {}};
  for (const v1::Warning& warning : response.warnings()) {
    planned.warnings.push_back({warning.reason(), warning.message()});
  }
  return planned;
}

absl::StatusOr<Job> Client::CreateJob(const std::string& scene, const PatchOptions& patch,
                                      const SolveOptions& solve) {
  v1::CreateSolveJobRequest request;
  request.set_scene(scene);
  *request.mutable_spec() = MakeSpec(patch, solve);
  request.set_request_id(NewRequestId());
  v1::SolveJob job;
  absl::Status status = stubs_->caller.Call(scene, kWriteDeadline, [&](auto& context) {
    return stubs_->job->CreateSolveJob(&context, request, &job);
  });
  if (!status.ok()) return status;
  return FromProto(job);
}

absl::StatusOr<Job> Client::GetJob(const std::string& name) {
  v1::GetSolveJobRequest request;
  request.set_name(name);
  v1::SolveJob job;
  absl::Status status = stubs_->caller.Call(name, kReadDeadline, [&](auto& context) {
    return stubs_->job->GetSolveJob(&context, request, &job);
  });
  if (!status.ok()) return status;
  return FromProto(job);
}

absl::StatusOr<std::vector<Job>> Client::ListJobs() {
  std::vector<Job> jobs;
  v1::ListSolveJobsRequest request;
  request.set_page_size(kPageSize);
  do {
    v1::ListSolveJobsResponse page;
    absl::Status status = stubs_->caller.Call("jobs", kReadDeadline, [&](auto& context) {
      return stubs_->job->ListSolveJobs(&context, request, &page);
    });
    if (!status.ok()) return status;
    for (const v1::SolveJob& job : page.solve_jobs()) jobs.push_back(FromProto(job));
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return jobs;
}

absl::StatusOr<Job> Client::CancelJob(const std::string& name) {
  v1::CancelSolveJobRequest request;
  request.set_name(name);
  v1::SolveJob job;
  absl::Status status = stubs_->caller.Call(name, kWriteDeadline, [&](auto& context) {
    return stubs_->job->CancelSolveJob(&context, request, &job);
  });
  if (!status.ok()) return status;
  return FromProto(job);
}

absl::Status Client::DeleteJob(const std::string& name) {
  v1::DeleteSolveJobRequest request;
  request.set_name(name);
  bool may_be_gone = false;  // by an attempt whose answer was lost
  return stubs_->caller.Call(name, kWriteDeadline, [&](auto& context) {
    google::protobuf::Empty nothing;
    const grpc::Status status = stubs_->job->DeleteSolveJob(&context, request, &nothing);
    const bool is_gone = status.error_code() == grpc::StatusCode::NOT_FOUND && may_be_gone;
    may_be_gone = true;
    return is_gone ? grpc::Status::OK : status;
  });
}

absl::StatusOr<std::vector<Worker>> Client::ListWorkers() {
  std::vector<Worker> workers;
  v1::ListWorkersRequest request;
  request.set_page_size(kPageSize);
  do {
    v1::ListWorkersResponse page;
    absl::Status status = stubs_->caller.Call("workers", kReadDeadline, [&](auto& context) {
      return stubs_->farm->ListWorkers(&context, request, &page);
    });
    if (!status.ok()) return status;
    for (const v1::Worker& worker : page.workers()) workers.push_back(FromProto(worker));
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return workers;
}

absl::StatusOr<std::vector<Snapshot>> Client::ListSnapshots(const std::string& job) {
  std::vector<Snapshot> snapshots;
  v1::ListSnapshotsRequest request;
  request.set_parent(job);
  request.set_page_size(kPageSize);
  do {
    v1::ListSnapshotsResponse page;
    absl::Status status = stubs_->caller.Call(job, kReadDeadline, [&](auto& context) {
      return stubs_->snapshot->ListSnapshots(&context, request, &page);
    });
    if (!status.ok()) return status;
    for (const v1::Snapshot& snapshot : page.snapshots()) {
      snapshots.push_back({snapshot.version(), FromProto(snapshot.progress()), nullptr});
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return snapshots;
}

absl::StatusOr<Job> Client::Watch(const std::string& job, const WatchOptions& options) {
  return WatchJob(*stubs_->snapshot, stubs_->caller, job, options);
}

absl::StatusOr<Gathered> Client::Gather(const std::string& job, const GatherPoints& points,
                                        const GatherOptions& options,
                                        const std::function<void(size_t, size_t)>& on_progress) {
  return GatherOver(*stubs_->gather, stubs_->caller, stubs_->blobs, job, points, options,
                    on_progress);
}

absl::StatusOr<std::shared_ptr<const PatchSet>> Client::FetchPatches(const BlobRef& patch_set) {
  auto bytes = stubs_->blobs.Download(patch_set, "patch set");
  if (!bytes.ok()) return bytes.status();
  auto patches = DecodePatchSet(*bytes);
  if (!patches.ok()) return patches.status();
  return std::make_shared<const PatchSet>(*std::move(patches));
}

absl::StatusOr<std::shared_ptr<const Solution>> Client::FetchSolution(const BlobRef& solution) {
  auto bytes = stubs_->blobs.Download(solution, "solution");
  if (!bytes.ok()) return bytes.status();
  auto decoded = DecodeSolution(*bytes);
  if (!decoded.ok()) return decoded.status();
  return std::make_shared<const Solution>(*std::move(decoded));
}

}  // namespace lambert::client
