#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "lambert/v1/snapshot_service.grpc.pb.h"
#include "radiosity/core/error.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"
#include "server/stream/watch_cursor.h"

namespace lambert::server {
namespace {

constexpr char kSnapshots[] = "/snapshots/";

absl::Status SnapshotNotFound(const std::string& name) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"SNAPSHOT_NOT_FOUND", name, "there is no such snapshot", "ask for latest"});
}

using NoStream = Refused<grpc::ServerWriteReactor<v1::WatchSnapshotsResponse>>;

// One watcher. At most one write is under way; news that comes meanwhile waits in the job, where
// newer news replaces it. Lives until gRPC calls OnDone.
class WatchReactor : public grpc::ServerWriteReactor<v1::WatchSnapshotsResponse>,
                     public JobListener,
                     public std::enable_shared_from_this<WatchReactor> {
 public:
  static grpc::ServerWriteReactor<v1::WatchSnapshotsResponse>* Start(
      Coordinator* coordinator, const Identity& caller, const v1::WatchSnapshotsRequest& request) {
    absl::StatusOr<std::shared_ptr<Job>> job = coordinator->jobs().Find(request.parent(), caller);
    if (!job.ok()) return new NoStream(job.status());
    const absl::Status room = coordinator->quotas().BeginWatch(caller.name);
    if (!room.ok()) return new NoStream(room);
    auto reactor = std::make_shared<WatchReactor>(coordinator, caller.name);
    reactor->self_ = reactor;
    reactor->cursor_.emplace(*job, &coordinator->blobs(), request);
    (*job)->AddListener(reactor);
    reactor->OnNews();
    return reactor.get();
  }
  // Requires: BeginWatch for `watcher`.
  WatchReactor(Coordinator* coordinator, std::string watcher)
      : coordinator_(coordinator), watcher_(std::move(watcher)) {
    ++coordinator_->traffic().watchers;
  }
  ~WatchReactor() override {
    --coordinator_->traffic().watchers;
    coordinator_->quotas().EndWatch(watcher_);
  }

  void OnNews() override {
    absl::MutexLock lock(&mutex_);
    Pump();
  }
  void OnWriteDone(bool ok) override {
    absl::MutexLock lock(&mutex_);
    is_writing_ = false;
    is_gone_ |= !ok;
    Pump();
  }
  void OnCancel() override {
    absl::MutexLock lock(&mutex_);
    is_gone_ = true;
    Pump();
  }
  void OnDone() override { self_.reset(); }

 private:
  void Pump() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    if (is_writing_ || is_finished_ || !cursor_.has_value()) return;
    if (is_gone_) return End(absl::CancelledError("the watcher has gone"));
    if (coordinator_->is_shutting_down()) {
      return End(MakeError(absl::StatusCode::kUnavailable,
                           {"SHUTTING_DOWN", "lambert-server", "the server is stopping",
                            "watch again from the last version"}));
    }
    std::optional<v1::WatchSnapshotsResponse> next = cursor_->Next();
    if (next.has_value()) {
      message_ = *std::move(next);
      is_writing_ = true;
      StartWrite(&message_);
    } else if (cursor_->done()) {
      End(absl::OkStatus());
    }
  }
  void End(const absl::Status& status) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_) {
    is_finished_ = true;
    Finish(ToGrpc(status));
  }

  Coordinator* const coordinator_;
  const std::string watcher_;  // "" for anybody
  std::shared_ptr<WatchReactor> self_;
  absl::Mutex mutex_;
  std::optional<WatchCursor> cursor_;
  v1::WatchSnapshotsResponse message_ ABSL_GUARDED_BY(mutex_);
  bool is_writing_ ABSL_GUARDED_BY(mutex_) = false;
  bool is_gone_ ABSL_GUARDED_BY(mutex_) = false;
  bool is_finished_ ABSL_GUARDED_BY(mutex_) = false;
};

class SnapshotService : public v1::SnapshotService::CallbackService {
 public:
  SnapshotService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerWriteReactor<v1::WatchSnapshotsResponse>* WatchSnapshots(
      grpc::CallbackServerContext* context, const v1::WatchSnapshotsRequest* request) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClients);
    if (!caller.ok()) return new NoStream(caller.status());
    return WatchReactor::Start(coordinator_, *caller, *request);
  }
  grpc::ServerUnaryReactor* GetSnapshot(grpc::CallbackServerContext* context,
                                        const v1::GetSnapshotRequest* request,
                                        v1::Snapshot* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return Find(caller, request->name()); });
  }
  grpc::ServerUnaryReactor* ListSnapshots(grpc::CallbackServerContext* context,
                                          const v1::ListSnapshotsRequest* request,
                                          v1::ListSnapshotsResponse* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return List(caller, *request); });
  }

 private:
  absl::StatusOr<v1::ListSnapshotsResponse> List(const Identity& caller,
                                                 const v1::ListSnapshotsRequest& request) {
    absl::StatusOr<std::shared_ptr<Job>> job = coordinator_->jobs().Find(request.parent(), caller);
    if (!job.ok()) return job.status();
    std::map<std::string, v1::Snapshot> by_version;
    for (v1::Snapshot& snapshot : (*job)->snapshots()) {
      // Leading zeros, so that keys sort like numbers.
      const std::string version = std::to_string(snapshot.version());
      by_version[std::string(20 - version.size(), '0') + version] = std::move(snapshot);
    }
    absl::StatusOr<Page<v1::Snapshot>> page =
        TakePage(by_version, request.page_size(), request.page_token());
    if (!page.ok()) return page.status();
    v1::ListSnapshotsResponse response;
    for (v1::Snapshot& snapshot : page->items) *response.add_snapshots() = std::move(snapshot);
    response.set_next_page_token(page->next_page_token);
    return response;
  }
  absl::StatusOr<v1::Snapshot> Find(const Identity& caller, const std::string& name) {
    const size_t end = name.find(kSnapshots);
    if (end == std::string::npos) return SnapshotNotFound(name);
    absl::StatusOr<std::shared_ptr<Job>> job =
        coordinator_->jobs().Find(name.substr(0, end), caller);
    if (!job.ok()) return job.status();
    const std::vector<v1::Snapshot> snapshots = (*job)->snapshots();
    if (name.substr(end) == std::string(kSnapshots) + "latest" && !snapshots.empty()) {
      return snapshots.back();
    }
    for (const v1::Snapshot& snapshot : snapshots) {
      if (snapshot.name() == name) return snapshot;
    }
    return SnapshotNotFound(name);
  }

  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeSnapshotService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<SnapshotService>(coordinator, doors);
}

}  // namespace lambert::server
