// The coordinator without its network: stores, work and jobs, and what clients may ask of them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "absl/base/call_once.h"
#include "absl/status/statusor.h"
#include "absl/synchronization/notification.h"
#include "lambert/v1/solve_job_service.pb.h"
#include "radiosity/scene/load_gltf.h"
#include "server/base/clock.h"
#include "server/base/record_store.h"
#include "server/base/task_pool.h"
#include "server/base/traffic.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"
#include "server/blobs/uploads.h"
#include "server/doors/holdings.h"
#include "server/doors/quotas.h"
#include "server/gather/gathers.h"
#include "server/jobs/job_store.h"
#include "server/run/job_runner.h"
#include "server/run/scheduler.h"
#include "server/scenes/scene_store.h"
#include "server/work/work_table.h"

namespace lambert::server {

struct CoordinatorOptions {
  int64_t max_store_bytes = int64_t{8} << 30;  // of blobs in memory; unused with other stores
  UploadLimits uploads;
  SceneLimits scene;
  int64_t max_patches = 20'000'000;  // of one job
  int max_running_jobs = 2;          // > 0; others wait
  int max_waiting_jobs = 100;        // jobs that have not ended, > 0
  QuotaOptions quotas;
  std::function<int64_t()> day = DayNow;  // when quotas begin anew
  WorkOptions work;
  std::string unit_version;  // "": that of this program
  Clock clock = SteadyNow;
  JournalMode journal = JournalMode::kAuto;
  Log log = [](const LogLine&) {};
  // Told once, from any thread, that the stores belong to somebody else now (FENCED), or cannot be
  // reached (DATABASE_LOST): the coordinator has stopped its jobs, and its process should end.
  std::function<void(const absl::Status&)> on_stores_lost = [](const absl::Status&) {};
};

// Where a coordinator keeps what it has.
struct Stores {
  std::unique_ptr<BlobStore> blobs;
  std::unique_ptr<RecordStore> records;
};

// Thread safe. The methods that are slow say so.
class Coordinator {
 public:
  // Keeps everything in memory, gone with the process.
  static absl::StatusOr<std::unique_ptr<Coordinator>> Start(const CoordinatorOptions& options);
  // Finds scenes and jobs of an earlier run in `stores` and goes on with them.
  static absl::StatusOr<std::unique_ptr<Coordinator>> Start(const CoordinatorOptions& options,
                                                            Stores stores);
  // Stops jobs where they are; waits for the step of those that are building patches.
  ~Coordinator();

  // What would be done for a scene. Slow.
  absl::StatusOr<v1::PlanSceneResponse> PlanScene(const Identity& who,
                                                  const v1::PlanSceneRequest& request);
  absl::StatusOr<v1::SolveJob> CreateJob(const Identity& who,
                                         const v1::CreateSolveJobRequest& request);
  absl::StatusOr<v1::SolveJob> CancelJob(const Identity& who, const std::string& name);
  // SCENE_IN_USE while a job that has not ended solves it.
  absl::Status DeleteScene(const Identity& who, const std::string& name);
  // Lends no more work; results of what is lent are taken until all are there, or `grace` passed.
  void Drain(Duration grace) { work_.Drain(grace); }
  // Ends held calls, steps and watchers; jobs stay as they are. What comes later is refused.
  void Shutdown();
  bool is_shutting_down() const { return stopping_.HasBeenNotified(); }

  BlobStore& blobs() { return *blobs_; }
  Holdings& holdings() { return holdings_; }
  Quotas& quotas() { return quotas_; }
  SceneStore& scenes() { return scenes_; }
  JobStore& jobs() { return jobs_; }
  WorkTable& work() { return work_; }
  Gathers& gathers() { return gathers_; }
  TaskPool& pool() { return pool_; }
  Traffic& traffic() { return traffic_; }

 private:
  Coordinator(const CoordinatorOptions& options, Stores stores);
  absl::Status Restore();
  // Treats blobs that nobody needs as uploads of their age: what a crash left unnamed goes with
  // them.
  void AdoptOrphans();
  // Stops everything where the stores are no longer this coordinator's. Returns whether they are.
  bool OwnsStores();
  void KeepHouse();

  const CoordinatorOptions options_;
  const std::string unit_version_;
  const std::unique_ptr<BlobStore> blobs_;
  const std::unique_ptr<RecordStore> records_;
  BlobRefs refs_;
  Uploads uploads_;
  Quotas quotas_;
  SceneStore scenes_;
  JobStore jobs_;
  Holdings holdings_;
  WorkTable work_;
  Traffic traffic_;
  const RunnerParts parts_;
  JobRunner runner_;
  Gathers gathers_;
  std::unique_ptr<Scheduler> scheduler_;
  TaskPool pool_;
  absl::once_flag stopped_;
  absl::Notification stopping_;
  std::thread housekeeper_;
};

}  // namespace lambert::server
