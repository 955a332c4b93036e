#include "client/watch.h"

#include <optional>
#include <utility>

#include "client/convert.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

// Puts the messages of a stream together; outlives the connections.
class Watcher {
 public:
  explicit Watcher(const WatchOptions& options)
      : options_(options), version_(options.last_version) {}

  // A new connection begins with a whole snapshot.
  void Attach() { begun_.reset(); }
  // Takes the next message; an error is the end of the watch.
  absl::Status Take(const v1::WatchSnapshotsResponse& response);

  int64_t version() const { return version_; }
  std::optional<Job> TakeJob() { return std::move(job_); }

 private:
  absl::Status TakeSnapshot(const v1::Snapshot& snapshot);
  absl::Status TakeChunk(const std::string& chunk);
  absl::Status Deliver();

  const WatchOptions& options_;
  int64_t version_;
  std::optional<v1::Snapshot> begun_;  // whose payload is coming in
  std::string payload_;
  std::optional<Job> job_;  // once it has ended
};

absl::Status Garbled(const std::string& message) {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"STREAM_GARBLED", "snapshots", message, "watch the job again"});
}

absl::Status Watcher::Take(const v1::WatchSnapshotsResponse& response) {
  switch (response.news_case()) {
    case v1::WatchSnapshotsResponse::kSnapshot:
      return TakeSnapshot(response.snapshot());
    case v1::WatchSnapshotsResponse::kPayloadChunk:
      return TakeChunk(response.payload_chunk());
    case v1::WatchSnapshotsResponse::kProgress:
      options_.on_progress(FromProto(response.progress()));
      return absl::OkStatus();
    case v1::WatchSnapshotsResponse::kJobEnded:
      job_ = FromProto(response.job_ended());
      return absl::OkStatus();
    default:
      return absl::OkStatus();  // news of a later version of the protocol
  }
}

absl::Status Watcher::TakeSnapshot(const v1::Snapshot& snapshot) {
  begun_ = snapshot;
  payload_.clear();
  return options_.with_solutions ? absl::OkStatus() : Deliver();
}

absl::Status Watcher::TakeChunk(const std::string& chunk) {
  if (!begun_) return Garbled("a payload came without its snapshot");
  payload_ += chunk;
  const int64_t wanted = begun_->payload_digest().size_bytes();
  const auto size = static_cast<int64_t>(payload_.size());
  if (size < wanted) return absl::OkStatus();
  if (size > wanted || Sha256Hex(payload_) != begun_->payload_digest().sha256()) {
    return Garbled("a snapshot does not have the digest that it was announced with");
  }
  return Deliver();
}

absl::Status Watcher::Deliver() {
  Snapshot snapshot{begun_->version(), FromProto(begun_->progress()), nullptr};
  begun_.reset();
  if (options_.with_solutions) {
    auto solution = DecodeSolution(payload_);
    if (!solution.ok()) return solution.status();
    snapshot.solution = std::make_shared<const Solution>(*std::move(solution));
  }
  // After a server's restart from its last checkpoint, passes may come a second time.
  if (snapshot.version <= version_) return absl::OkStatus();
  version_ = snapshot.version;
  return options_.on_snapshot(snapshot);
}

}  // namespace

absl::StatusOr<Job> WatchJob(v1::SnapshotService::StubInterface& stub, Caller& caller,
                             const std::string& job, const WatchOptions& options) {
  Watcher watcher(options);
  absl::Status refused;
  const auto attempt = [&](grpc::ClientContext& context) {
    watcher.Attach();
    v1::WatchSnapshotsRequest request;
    request.set_parent(job);
    request.set_last_version(watcher.version());
    request.set_view(options.with_solutions ? v1::SNAPSHOT_VIEW_FULL : v1::SNAPSHOT_VIEW_BASIC);
    auto reader = stub.WatchSnapshots(&context, request);
    v1::WatchSnapshotsResponse response;
    while (refused.ok() && reader->Read(&response)) {
      caller.Reached();
      refused = watcher.Take(response);
      if (!refused.ok()) context.TryCancel();
    }
    const grpc::Status status = reader->Finish();
    return refused.ok() ? status : grpc::Status::OK;
  };
  const absl::Status status = caller.Call(
      job, std::chrono::duration<double>(0), attempt,
      "when it is back, go on with: lambert watch " + job + " --server " + caller.server());
  if (!refused.ok()) return refused;
  std::optional<Job> ended = watcher.TakeJob();
  if (ended) return *std::move(ended);
  if (!status.ok()) return status;
  return Garbled("the stream ended before the job did");
}

}  // namespace lambert::client
