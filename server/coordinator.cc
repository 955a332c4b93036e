#include "server/coordinator.h"

#include <utility>
#include <vector>

#include "absl/base/call_once.h"
#include "absl/time/clock.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/solve/plan.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"

namespace lambert::server {
namespace {

constexpr int kPoolThreads = 2;
constexpr absl::Duration kTick = absl::Milliseconds(50);
// Watchers take 30 s of silence for a broken connection.
constexpr auto kRepeatProgress = std::chrono::seconds(10);
constexpr auto kDropIdle = std::chrono::minutes(1);
constexpr auto kCheckOwner = std::chrono::seconds(1);
constexpr int kEpochShift = 40;  // a run of a server uses fewer numbers than 2^40

// Of steps and sessions: grows from one run of a server to the next.
int64_t FirstNumber(const RecordStore& records) {
  if (records.keeps()) return records.epoch() << kEpochShift;
  return absl::ToUnixMicros(absl::Now()) * 1000;
}

}  // namespace

Coordinator::Coordinator(const CoordinatorOptions& options, Stores stores)
    : options_(options),
      unit_version_(options.unit_version.empty() ? UnitVersion() : options.unit_version),
      blobs_(std::move(stores.blobs)),
      records_(std::move(stores.records)),
      refs_(blobs_.get(), options.uploads.idle, options.clock),
      uploads_(blobs_.get(), options.uploads, options.clock),
      quotas_(options.quotas, options.day, records_.get()),
      scenes_(blobs_.get(), &refs_, records_.get(), options.scene),
      jobs_(&refs_, records_.get(), &quotas_, options.max_waiting_jobs),
      holdings_(blobs_.get(), &refs_, &uploads_, &scenes_, &jobs_, &quotas_, &work_),
      work_(options.work, unit_version_, FirstNumber(*records_), options.clock),
      parts_({blobs_.get(), &refs_, records_.get(), &scenes_, &jobs_, &holdings_, &quotas_, &work_,
              options.max_patches, options.journal, options.clock, options.log}),
      runner_(parts_),
      gathers_(parts_),
      pool_(kPoolThreads) {}

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Start(const CoordinatorOptions& options) {
  return Start(options, {MakeMemoryBlobStore(options.max_store_bytes), MakeNullRecordStore()});
}

absl::StatusOr<std::unique_ptr<Coordinator>> Coordinator::Start(const CoordinatorOptions& options,
                                                                Stores stores) {
  std::unique_ptr<Coordinator> coordinator(new Coordinator(options, std::move(stores)));
  if (absl::Status restored = coordinator->Restore(); !restored.ok()) return restored;
  coordinator->housekeeper_ = std::thread([self = coordinator.get()] { self->KeepHouse(); });
  return coordinator;
}

absl::Status Coordinator::Restore() {
  if (absl::Status restored = quotas_.Restore(); !restored.ok()) return restored;
  if (absl::Status restored = scenes_.Restore(); !restored.ok()) return restored;
  absl::StatusOr<std::vector<std::shared_ptr<Job>>> unfinished = jobs_.Restore();
  if (!unfinished.ok()) return unfinished.status();
  AdoptOrphans();
  scheduler_ = std::make_unique<Scheduler>(&runner_, options_.max_running_jobs);
  for (std::shared_ptr<Job>& job : *unfinished) {
    if (job->Get().unit_version() != unit_version_) {
      // Passes of two versions must not be mixed: begin again.
      Journal journal(job->id(), blobs_.get(), &refs_, records_.get());
      if (absl::Status loaded = journal.Load(); !loaded.ok()) return loaded;
      job->Update([this](v1::SolveJob& record) { record.set_unit_version(unit_version_); });
      if (absl::Status saved = jobs_.Save(*job, {journal.Clear()}); !saved.ok()) return saved;
      journal.Settle();
    }
    options_.log({"the job is gone on with", {.job = job->name()}});
    scheduler_->Add(std::move(job));
  }
  return absl::OkStatus();
}

void Coordinator::AdoptOrphans() {
  for (const StoredBlob& blob : blobs_->List()) refs_.NoteUpload(blob.sha256, "", 0, blob.age);
  refs_.DropIdle();
}

Coordinator::~Coordinator() {
  Shutdown();
  scheduler_.reset();
  quotas_.Save().IgnoreError();  // a full disk tells of itself where jobs are kept
  if (housekeeper_.joinable()) housekeeper_.join();
}

void Coordinator::Shutdown() {
  absl::call_once(stopped_, [this] { stopping_.Notify(); });
  work_.Shutdown();
  for (const std::shared_ptr<Job>& job : jobs_.All()) job->RepeatProgress();  // wakes watchers
}

void Coordinator::KeepHouse() {
  TimePoint repeated = options_.clock(), dropped = repeated, checked = repeated;
  while (!stopping_.WaitForNotificationWithTimeout(kTick)) {
    work_.Tick();
    const TimePoint now = options_.clock();
    if (now - checked >= kCheckOwner) {
      checked = now;
      if (!OwnsStores()) return;
      quotas_.Save().IgnoreError();  // tried again in a second
    }
    if (now - repeated >= kRepeatProgress) {
      repeated = now;
      for (const std::shared_ptr<Job>& job : jobs_.All()) job->RepeatProgress();
    }
    if (now - dropped >= kDropIdle) {
      dropped = now;
      uploads_.DropIdle();
      refs_.DropIdle();
    }
  }
}

bool Coordinator::OwnsStores() {
  const absl::Status owned = records_->CheckOwner();
  if (!IsOwnershipLost(owned)) return true;
  Shutdown();
  options_.on_stores_lost(owned);
  return false;
}

absl::StatusOr<v1::PlanSceneResponse> Coordinator::PlanScene(const Identity& who,
                                                             const v1::PlanSceneRequest& request) {
  absl::StatusOr<JobOptions> options = DecodeSpec(request.spec(), options_.max_patches);
  if (!options.ok()) return options.status();
  absl::StatusOr<Scene> scene = scenes_.Load(request.scene(), who.name);
  if (!scene.ok()) return scene.status();
  absl::StatusOr<PatchSet> patches = BuildPatches(*scene, options->patch);
  if (!patches.ok()) return patches.status();
  const bool adapted = options->patch.adapt_patches > 0;
  if (absl::Status status = ValidateFor(*patches, options->solve, adapted); !status.ok()) {
    return status;
  }
  v1::PlanSceneResponse response;
  Plan plan = MakePlan(*patches, options->solve, adapted);
  AddMeshing(*patches, options->patch, plan);
  *response.mutable_plan() = EncodePlan(plan, request.spec());
  for (const Warning& warning : patches->warnings) {
    *response.add_warnings() = EncodeWarning(warning);
  }
  return response;
}

absl::StatusOr<v1::SolveJob> Coordinator::CreateJob(const Identity& who,
                                                    const v1::CreateSolveJobRequest& request) {
  absl::StatusOr<JobOptions> options = DecodeSpec(request.spec(), options_.max_patches);
  if (!options.ok()) return options.status();
  absl::StatusOr<v1::Scene> scene = scenes_.GetOwn(request.scene(), who.name);
  if (!scene.ok()) return scene.status();
  if (absl::Status room = holdings_.CheckBytes(who.name, 0); !room.ok()) return room;
  if (absl::Status left = quotas_.CheckWork(who.name); !left.ok()) return left;
  absl::StatusOr<JobStore::Created> created = jobs_.Create(request, *scene, unit_version_);
  if (!created.ok()) return created.status();
  if (created->is_new) {
    options_.log({"created for " + scene->display_name(), {.job = created->job->name()}});
    scheduler_->Add(created->job);
  }
  return created->job->Get();
}

absl::StatusOr<v1::SolveJob> Coordinator::CancelJob(const Identity& who, const std::string& name) {
  absl::StatusOr<std::shared_ptr<Job>> job = jobs_.Find(name, who);
  if (!job.ok()) return job.status();
  if ((*job)->CancelQueued()) {
    if (absl::Status saved = jobs_.Save(**job); !saved.ok()) return saved;
  } else if (!(*job)->ended()) {
    work_.AbortJob((*job)->id(), absl::CancelledError("a client cancelled the job"));
    if ((*job)->ended()) work_.ForgetJob((*job)->id());  // it ended meanwhile
  }
  return (*job)->Get();
}

absl::Status Coordinator::DeleteScene(const Identity& who, const std::string& name) {
  absl::StatusOr<v1::Scene> scene = scenes_.Get(name, who);
  if (!scene.ok()) return scene.status();
  if (jobs_.UsesScene(name, scene->owner())) {
    return MakeError(
        absl::StatusCode::kFailedPrecondition,
        {"SCENE_IN_USE", name, "a job that has not ended solves it", "cancel the job first"});
  }
  return scenes_.Delete(*scene);
}

}  // namespace lambert::server
