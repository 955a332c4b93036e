// A client of a Lambert server, or of a whole service in this process (local/).
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/job.h"
#include "radiosity/core/warning.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/solve/options.h"
#include "radiosity/solve/solution.h"

namespace grpc {
class Channel;
}

namespace lambert::client {

struct ClientOptions {
  std::string server = "this process";         // names the other side in messages
  std::chrono::duration<double> patience{60};  // how long a server that is away is tried again
  // Told when the server is lost and when it is back: one line each. May be called on any thread
  // that calls the client.
  std::function<void(const std::string&)> on_notice = [](const std::string&) {};
};

struct SubmittedScene {
  std::string name;               // "scenes/SHA256"
  std::string digest;             // the SHA256
  std::vector<Warning> warnings;  // of reading it
};

struct PlannedScene {
  Plan plan;
  std::vector<Warning> warnings;  // of reading and of patching
};

// What a watcher wants to hear. Called on the thread that watches, one at a time.
struct WatchOptions {
  int64_t last_version = 0;     // of the newest snapshot that is known already
  bool with_solutions = false;  // true: Snapshot::solution is there, else it is null
  std::function<void(const Progress&)> on_progress = [](const Progress&) {};
  // An error ends the watch, and Watch returns it.
  std::function<absl::Status(const Snapshot&)> on_snapshot = [](const Snapshot&) {
    return absl::OkStatus();
  };
};

// Every call has a deadline, and is repeated while the server is away, up to `patience`; then it
// fails with UNAVAILABLE, reason SERVER_UNREACHABLE. Errors of the server keep code, reason, where,
// message and hint. Any thread; several calls at a time.
class Client {
 public:
  Client(std::shared_ptr<grpc::Channel> channel, ClientOptions options);
  ~Client();

  // Uploads what the server lacks of the bundle and has it read. `on_upload`: bytes done, of all.
  absl::StatusOr<SubmittedScene> SubmitScene(
      const SceneBundle& bundle, const std::function<void(int64_t, int64_t)>& on_upload);
  absl::StatusOr<PlannedScene> PlanScene(const std::string& scene, const PatchOptions& patch,
                                         const SolveOptions& solve);
  // Starts one job, however often the call has to be repeated.
  absl::StatusOr<Job> CreateJob(const std::string& scene, const PatchOptions& patch,
                                const SolveOptions& solve);

  absl::StatusOr<Job> GetJob(const std::string& name);
  absl::StatusOr<std::vector<Job>> ListJobs();
  absl::StatusOr<Job> CancelJob(const std::string& name);
  absl::Status DeleteJob(const std::string& name);
  absl::StatusOr<std::vector<Worker>> ListWorkers();
  // By version, without solutions: how the error fell.
  absl::StatusOr<std::vector<Snapshot>> ListSnapshots(const std::string& job);

  // Follows a job until it has ended, and returns it as it ended. Attaches again by itself when the
  // server comes back.
  absl::StatusOr<Job> Watch(const std::string& job, const WatchOptions& options);

  // Verified by digest. Requires: the reference is of a patch set, or of a solution.
  absl::StatusOr<std::shared_ptr<const PatchSet>> FetchPatches(const BlobRef& patch_set);
  absl::StatusOr<std::shared_ptr<const Solution>> FetchSolution(const BlobRef& solution);

  // Gathers at points from the job's newest snapshot, on the server's workers; goes on where the
  // server starts again meanwhile. `on_progress`: points done, of all. The same question has the
  // same answer, to the bit, and is split here where it is large.
  absl::StatusOr<Gathered> Gather(const std::string& job, const GatherPoints& points,
                                  const GatherOptions& options,
                                  const std::function<void(size_t, size_t)>& on_progress);

  // Makes the calls in progress and all later ones fail with CANCELLED (reason INTERRUPTED).
  void Abort();

 private:
  struct Stubs;
  const std::unique_ptr<Stubs> stubs_;
};

}  // namespace lambert::client
