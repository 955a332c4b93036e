// One scene from its file to the output folder, over a server or in this process: the same steps.
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include "app/commands.h"
#include "app/idle_notice.h"
#include "app/light_files.h"
#include "app/measure.h"
#include "app/progress.h"
#include "app/progress_text.h"
#include "app/result.h"
#include "app/scene_files.h"
#include "app/service.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"
#include "radiosity/output/convergence.h"
#include "radiosity/output/write_outputs.h"
#include "radiosity/patch/place.h"

namespace lambert::app {
namespace {

class Bake {
 public:
  Bake(const Options& options, Interrupt& interrupt)
      : options_(options),
        interrupt_(interrupt),
        printer_(ResolveProgressMode(options.progress, stderr), stderr, MonotonicSeconds),
        last_mark_s_(MonotonicSeconds()) {
    printer_.SetTimeBudget(options.solve.max_time_s);
  }
  ~Bake() { interrupt_.OnFirst(nullptr); }

  absl::StatusOr<ExitCode> Run();

 private:
  // Everything that can be found wrong before any work is done.
  absl::Status Prepare();
  absl::StatusOr<client::Job> Submit();
  absl::StatusOr<client::Job> Follow(const client::Job& job);
  absl::Status TakeSnapshot(const std::string& job, const Snapshot& snapshot);
  // The patches and the plan, as soon as the job has them.
  absl::Status LearnScene(const std::string& job);
  absl::Status Log(const Progress& progress, const Solution* solution);
  absl::StatusOr<ExitCode> Finish(const client::Job& job);
  // The files of the result; one that is stopped by hand is written without a final gather.
  absl::Status Write(const client::Job& job, RunRecord& record);
  // What files that show textures or have a lightmap are made of.
  absl::Status AddScene(RunRecord& record);
  void WarnOnce(const std::vector<Warning>& warnings);
  void Mark(const std::string& what);
  void CountWorkers(RunRecord& record);

  const Options& options_;
  Interrupt& interrupt_;
  ProgressPrinter printer_;
  SceneBundle bundle_;
  std::vector<SensorGrid> sensors_;
  Measurer measurer_;
  std::optional<ConvergenceLog> log_;
  Service service_;
  std::optional<client::Job> known_;         // as it was at the first snapshot
  std::shared_ptr<const PatchSet> patches_;  // fetched at the first snapshot where it is measured
  std::vector<ConvergenceRow> rows_;
  int64_t logged_version_ = 0;
  std::set<std::string> warned_;
  std::vector<std::pair<std::string, double>> timings_s_;
  double last_mark_s_;
};

absl::StatusOr<ExitCode> Bake::Run() {
  if (absl::Status status = Prepare(); !status.ok()) return status;
  auto job = Submit();
  if (!job.ok()) return job.status();
  auto ended = Follow(*job);
  printer_.Finish();
  if (!ended.ok()) return ended.status();
  WarnOnce(ended->warnings);
  return Finish(*ended);
}

absl::Status Bake::Prepare() {
  auto bundle = ReadLitBundle(options_.scene_path, options_);
  if (!bundle.ok()) return bundle.status();
  bundle_ = *std::move(bundle);
  if (absl::Status status = TestOutputFolder(options_.out_folder); !status.ok()) return status;
  absl::Status kept = CheckSceneIsKept(options_.scene_path, options_.out_folder);
  if (!kept.ok()) return kept;
  auto sensors = ReadOptionalSensors(options_);
  if (!sensors.ok()) return sensors.status();
  sensors_ = *std::move(sensors);
  auto measurer = Measurer::Create(options_.reference_path, options_.regions);
  if (!measurer.ok()) return measurer.status();
  measurer_ = *std::move(measurer);
  auto service = OpenService(options_, [this](const std::string& line) { printer_.Note(line); });
  if (!service.ok()) return service.status();
  service_ = *std::move(service);
  return absl::OkStatus();
}

absl::StatusOr<client::Job> Bake::Submit() {
  client::Client& client = *service_.client;
  interrupt_.OnFirst([&client] { client.Abort(); });
  const bool remote = service_.local == nullptr;
  double said_at_s = MonotonicSeconds();
  auto scene = client.SubmitScene(bundle_, [&](int64_t done, int64_t total) {
    if (!remote || done == total || MonotonicSeconds() - said_at_s < 1) return;
    said_at_s = MonotonicSeconds();
    printer_.Stage(fmt::format("uploaded {}: {} of {}", bundle_.main_name, FormatBytes(done),
                               FormatBytes(total)));
  });
  if (!scene.ok()) return scene.status();
  WarnOnce(scene->warnings);
  auto job = client.CreateJob(scene->name, options_.patch, options_.solve);
  if (!job.ok()) return job.status();
  if (!options_.outputs.glb && !options_.lightmap) bundle_ = {};  // the server has it now
  Mark("submit");
  if (remote) printer_.Stage(fmt::format("{} at {}", job->name, options_.server));
  return job;
}

absl::StatusOr<client::Job> Bake::Follow(const client::Job& job) {
  auto log = ConvergenceLog::Create(options_.out_folder + "/convergence.csv");
  if (!log.ok()) return log.status();
  log_.emplace(*std::move(log));
  client::Client& client = *service_.client;
  interrupt_.OnFirst([&] {
    printer_.Note("stopping, and keeping the best so far; Ctrl-C again leaves at once");
    // Without an answer there is nothing to wait for.
    if (!client.CancelJob(job.name).ok()) client.Abort();
  });
  client::WatchOptions watch;
  watch.with_solutions = measurer_.wanted();
  IdleNotice idle(&client, &printer_, options_.server);
  watch.on_progress = [&](const Progress& progress) {
    printer_.Update(progress);
    idle.Check(progress);
  };
  watch.on_snapshot = [&](const Snapshot& snapshot) { return TakeSnapshot(job.name, snapshot); };
  auto ended = client.Watch(job.name, watch);
  if (!ended.ok() && !interrupt_.seen() &&
      ended.status().code() != absl::StatusCode::kUnavailable) {
    // What went wrong is on this side (a full disk, another scene's reference): nobody waits for
    // the job any more.
    (void)client.CancelJob(job.name);
  }
  interrupt_.OnFirst(nullptr);
  Mark("solve");
  return ended;
}

absl::Status Bake::TakeSnapshot(const std::string& job, const Snapshot& snapshot) {
  if (absl::Status status = LearnScene(job); !status.ok()) return status;
  printer_.Update(snapshot.progress);
  logged_version_ = snapshot.version;
  return Log(snapshot.progress, snapshot.solution.get());
}

absl::Status Bake::LearnScene(const std::string& job) {
  if (known_) return absl::OkStatus();
  auto known = service_.client->GetJob(job);
  if (!known.ok()) return known.status();
  known_ = *std::move(known);
  WarnOnce(known_->warnings);
  printer_.Stage(fmt::format("{} patches, method {}", known_->plan.patches,
                             MethodName(known_->plan.options.shoot.method)));
  if (!measurer_.wanted()) return absl::OkStatus();
  auto patches = service_.client->FetchPatches(known_->patch_set);
  if (!patches.ok()) return patches.status();
  patches_ = *std::move(patches);
  return absl::OkStatus();
}

absl::Status Bake::Log(const Progress& progress, const Solution* solution) {
  ConvergenceRow row = MakeConvergenceRow(known_->plan, progress);
  if (measurer_.wanted() && solution != nullptr) {
    auto measures = measurer_.Measure(*patches_, *solution);
    if (!measures.ok()) return measures.status();
    row.measures = *measures;
  }
  rows_.push_back(row);
  return log_->Append(row);
}

absl::StatusOr<ExitCode> Bake::Finish(const client::Job& job) {
  if (job.snapshot_version == 0) {
    if (job.state == client::JobState::kFailed) return job.error;
    return MakeError(
        absl::StatusCode::kCancelled,
        {"INTERRUPTED", job.name, "stopped before there was any result", "run the command again"});
  }
  auto record = CollectRecord(*service_.client, job, patches_);
  if (!record.ok()) return record.status();
  patches_ = record->patches;
  if (!known_) known_ = job;
  // The last snapshot may have come with the job's end instead of with the stream.
  if (job.snapshot_version > logged_version_) {
    absl::Status status = Log(record->snapshot.progress, record->snapshot.solution.get());
    if (!status.ok()) return status;
  }
  if (measurer_.wanted()) record->measures = rows_.back().measures;
  Mark("fetch");
  record->convergence = rows_;
  record->timings_s = timings_s_;
  CountWorkers(*record);
  if (absl::Status status = AddScene(*record); !status.ok()) return status;
  if (absl::Status status = Write(job, *record); !status.ok()) return status;
  PrintSummary(job, *record, options_.out_folder, options_.json);
  return ExitCodeOf(job);
}

absl::Status Bake::Write(const client::Job& job, RunRecord& record) {
  client::Client& client = *service_.client;
  const auto say = [this](const std::string& line) { printer_.Stage(line); };
  interrupt_.OnFirst([&client] { client.Abort(); });
  absl::Status status = GatherAndWrite(client, job, options_, std::move(sensors_), say, record);
  interrupt_.OnFirst(nullptr);
  if (ReasonOf(status) != "INTERRUPTED") return status;
  printer_.Note("what is not gathered yet is left out");
  record.final_gather_rays = 0;
  return WriteOutputs(options_.out_folder, record, options_.outputs);
}

absl::Status Bake::AddScene(RunRecord& record) {
  if (!options_.outputs.NeedPicture() && !options_.lightmap) return absl::OkStatus();
  const Keep keep = options_.lightmap ? Keep::kAppearance : Keep::kLight;
  auto scene = LoadGltf(bundle_, options_.limits, keep);
  if (!scene.ok()) return scene.status();
  if (!SourcesExist(*scene, *record.patches)) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"PATCHES_INVALID", "patch set", "it is not of this scene",
                      "submit the scene again, or ask who runs the server"});
  }
  ScaleInstances(options_.patch.metres_per_unit, *scene);
  record.scene = std::make_shared<const Scene>(*std::move(scene));
  if (!options_.lightmap) return absl::OkStatus();
  printer_.Stage("lightmap");
  auto atlas = BuildAtlas(*record.scene, *record.patches, options_.lightmap_options);
  if (!atlas.ok()) return atlas.status();
  WarnOnce(atlas->warnings);
  record.atlas = std::make_shared<const Atlas>(*std::move(atlas));
  return absl::OkStatus();
}

void Bake::WarnOnce(const std::vector<Warning>& warnings) {
  for (const Warning& warning : warnings) {
    if (warned_.insert(warning.message).second) printer_.Warn(warning);
  }
}

void Bake::Mark(const std::string& what) {
  const double now_s = MonotonicSeconds();
  timings_s_.emplace_back(what, now_s - last_mark_s_);
  last_mark_s_ = now_s;
}

void Bake::CountWorkers(RunRecord& record) {
  if (service_.local != nullptr) {
    record.workers = options_.workers;
    record.threads = ThreadsPerWorker(options_);
  } else if (auto workers = service_.client->ListWorkers(); workers.ok()) {
    record.workers = static_cast<int>(workers->size());
  }
}

}  // namespace

absl::StatusOr<ExitCode> RunBake(const Options& options, Interrupt& interrupt) {
  return Bake(options, interrupt).Run();
}

}  // namespace lambert::app
