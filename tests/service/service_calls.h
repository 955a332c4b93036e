// The calls that a client makes, as plain functions for tests.
#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "lambert/v1/blob_service.grpc.pb.h"
#include "lambert/v1/scene_service.grpc.pb.h"
#include "lambert/v1/snapshot_service.grpc.pb.h"
#include "lambert/v1/solve_job_service.grpc.pb.h"
#include "radiosity/core/digest.h"
#include "tests/support/scenes.h"

namespace lambert {

// The ErrorInfo that came with a status; every error has one.
inline google::rpc::ErrorInfo ErrorInfoOf(const grpc::Status& status) {
  google::rpc::Status details;
  google::rpc::ErrorInfo info;
  details.ParseFromString(status.error_details());
  if (details.details_size() > 0) details.details(0).UnpackTo(&info);
  return info;
}

inline std::string ReasonOf(const grpc::Status& status) { return ErrorInfoOf(status).reason(); }

inline v1::Digest DigestOf(const std::string& bytes) {
  v1::Digest digest;
  digest.set_sha256(Sha256Hex(bytes));
  digest.set_size_bytes(static_cast<int64_t>(bytes.size()));
  return digest;
}

class ServiceCalls {
 public:
  void Connect(std::shared_ptr<grpc::Channel> channel) { channel_ = std::move(channel); }
  const std::shared_ptr<grpc::Channel>& channel() const { return channel_; }

  std::unique_ptr<v1::BlobService::Stub> blobs() { return v1::BlobService::NewStub(channel_); }
  std::unique_ptr<v1::SceneService::Stub> scenes() { return v1::SceneService::NewStub(channel_); }
  std::unique_ptr<v1::SolveJobService::Stub> jobs() {
    return v1::SolveJobService::NewStub(channel_);
  }
  std::unique_ptr<v1::SnapshotService::Stub> snapshots() {
    return v1::SnapshotService::NewStub(channel_);
  }

  // Sends `data` from an offset on, in pieces of `piece` bytes.
  grpc::Status Upload(const v1::Digest& digest, const std::string& data, int64_t offset = 0,
                      size_t piece = size_t{1} << 20) {
    grpc::ClientContext context;
    v1::UploadBlobResponse response;
    auto writer = blobs()->UploadBlob(&context, &response);
    v1::UploadBlobRequest request;
    *request.mutable_digest() = digest;
    size_t sent = 0;
    do {
      request.set_offset_bytes(offset + static_cast<int64_t>(sent));
      request.set_data(data.substr(sent, piece));
      sent += request.data().size();
    } while (writer->Write(request) && sent < data.size());
    writer->WritesDone();
    return writer->Finish();
  }
  grpc::Status CreateScene(const std::string& glb, v1::Scene* scene) {
    if (grpc::Status status = Upload(DigestOf(glb), glb); !status.ok()) return status;
    v1::CreateSceneRequest request;
    v1::SceneFile* file = request.add_files();
    file->set_uri("room.glb");
    *file->mutable_digest() = DigestOf(glb);
    grpc::ClientContext context;
    return scenes()->CreateScene(&context, request, scene);
  }
  // A job on a Cornell box of 32 n^2 patches with a budget of rays.
  v1::SolveJob CreateJob(int64_t max_rays = 100'000, const std::string& id = "", int n = 2,
                         const std::string& method = "") {
    v1::Scene scene;
    const grpc::Status made = CreateScene(ToGlb(MakeCornell(n)), &scene);
    EXPECT_TRUE(made.ok()) << made.error_message();
    v1::CreateSolveJobRequest request;
    request.set_scene(scene.name());
    request.set_solve_job_id(id);
    request.mutable_spec()->set_max_ray_count(max_rays);
    request.mutable_spec()->mutable_shoot()->set_method(method);
    if (method == "importance") request.mutable_spec()->mutable_shoot()->add_region("0");
    v1::SolveJob job;
    grpc::ClientContext context;
    const grpc::Status status = jobs()->CreateSolveJob(&context, request, &job);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return job;
  }

  struct Watched {
    grpc::Status status;
    std::vector<v1::Snapshot> snapshots;
    std::string payload;  // of the last snapshot
    v1::SolveJob ended;
  };
  // Watches a job to its end.
  Watched Watch(const std::string& job, int64_t last_version = 0) {
    grpc::ClientContext context;
    v1::WatchSnapshotsRequest request;
    request.set_parent(job);
    request.set_view(v1::SNAPSHOT_VIEW_FULL);
    request.set_last_version(last_version);
    auto reader = snapshots()->WatchSnapshots(&context, request);
    Watched watched;
    v1::WatchSnapshotsResponse news;
    while (reader->Read(&news)) {
      if (news.has_snapshot()) {
        watched.snapshots.push_back(news.snapshot());
        watched.payload.clear();
      }
      watched.payload += news.payload_chunk();
      if (news.has_job_ended()) watched.ended = news.job_ended();
    }
    watched.status = reader->Finish();
    return watched;
  }

 private:
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace lambert
