#include "server/run/patch_maker.h"

#include <utility>

#include "radiosity/core/digest.h"
#include "radiosity/solve/solver.h"
#include "server/run/job_steps.h"

namespace lambert::server {

absl::StatusOr<std::shared_ptr<const PatchSet>> PatchMaker::Make(const JobOptions& options) {
  const v1::SolveJob record = job_.Get();
  const bool adapts = options.patch.adapt_patches > 0;
  if (record.has_patch_set_digest() && (!adapts || record.has_meshing())) {
    return ReadBack(record.patch_set_digest());
  }
  absl::StatusOr<Scene> scene = parts_.scenes->Load(record.scene(), job_.owner());
  if (!scene.ok()) return scene.status();
  if (adapts) return Adapt(*scene, options);
  absl::StatusOr<PatchSet> built = BuildPatches(*scene, options.patch);
  if (!built.ok()) return built.status();
  const auto patches = std::make_shared<const PatchSet>(*std::move(built));
  if (absl::Status stored = Store(patches); !stored.ok()) return stored;
  return patches;
}

absl::StatusOr<std::shared_ptr<const PatchSet>> PatchMaker::ReadBack(
    const v1::Digest& digest) const {
  absl::StatusOr<std::shared_ptr<const Blob>> blob = parts_.blobs->Get(digest.sha256());
  if (!blob.ok()) return blob.status();
  absl::StatusOr<PatchSet> patches = DecodePatchSet(std::string((*blob)->bytes()));
  if (!patches.ok()) return patches.status();
  return std::make_shared<const PatchSet>(*std::move(patches));
}

absl::StatusOr<std::shared_ptr<const PatchSet>> PatchMaker::Adapt(const Scene& scene,
                                                                  const JobOptions& options) {
  const TimePoint began = parts_.clock();
  const auto run = [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
                       int32_t) {
    absl::StatusOr<Solution> solution = RunPilot(patches, pilot);
    meshing_.seconds = ToSeconds(parts_.clock() - began);
    return solution;
  };
  absl::StatusOr<std::shared_ptr<const PatchSet>> patches =
      AdaptMesh(scene, options.patch, options.solve, run, &meshing_);
  if (!patches.ok()) return patches.status();
  meshing_.seconds = ToSeconds(parts_.clock() - began);
  if (absl::Status stored = Store(*patches); !stored.ok()) return stored;
  job_.Update([&](v1::SolveJob& record) { *record.mutable_meshing() = EncodeMeshing(meshing_); });
  best_.reset();
  return patches;
}

absl::StatusOr<std::optional<PilotResult>> PatchMaker::TakeBest() {
  if (!best_.has_value()) return std::nullopt;
  if (absl::Status stored = Store(best_->patches); !stored.ok()) return stored;
  meshing_.reason = "it was stopped";
  best_->plan.items.push_back(TellMeshing(meshing_, best_->patches->size()));
  return std::exchange(best_, std::nullopt);
}

absl::StatusOr<Solution> PatchMaker::RunPilot(const std::shared_ptr<const PatchSet>& patches,
                                              const SolveOptions& pilot) {
  if (absl::Status stored = Store(patches); !stored.ok()) return stored;
  const Plan plan = MakePlan(*patches, pilot);
  Solver solver(patches, plan.options,
                [this] { return ToSeconds(parts_.clock().time_since_epoch()); });
  JobSteps steps(parts_, job_, journal_, patches->size(), plan.options.shoot, {});
  const auto on_step = [&](Progress progress) {
    progress.pilot = meshing_.pilots;
    progress.pilot_patches = patches->size();
    steps.OnStep(progress);
  };
  absl::Status status;
  while (status.ok() && solver.stop_reason() == StopReason::kNone) {
    status = solver.RunPass(steps.executor(), on_step);
  }
  lambert::Snapshot snapshot = solver.MakeSnapshot();
  meshing_.pilot_rays += snapshot.progress.rays;
  const std::shared_ptr<const Solution> solution = snapshot.solution;
  if (snapshot.progress.rays > 0) best_ = PilotResult{patches, plan, std::move(snapshot)};
  if (!status.ok()) return status;
  return *solution;
}

absl::Status PatchMaker::Store(const std::shared_ptr<const PatchSet>& patches) {
  if (stored_.lock() == patches) return absl::OkStatus();
  std::string bytes = EncodePatchSet(*patches);
  v1::Digest digest;
  digest.set_sha256(Sha256Hex(bytes));
  digest.set_size_bytes(static_cast<int64_t>(bytes.size()));
  absl::Status room = parts_.holdings->CheckBytes(job_.owner(), digest.size_bytes());
  if (!room.ok()) return room;
  parts_.refs->Add(digest.sha256());
  absl::Status stored = parts_.blobs->Put(digest.sha256(), std::move(bytes));
  if (!stored.ok()) {
    parts_.refs->Release(digest.sha256());
    return stored;
  }
  const v1::Digest old = job_.Get().patch_set_digest();
  job_.Update([&](v1::SolveJob& record) { *record.mutable_patch_set_digest() = digest; });
  if (!old.sha256().empty()) parts_.refs->Release(old.sha256());
  stored_ = patches;
  return absl::OkStatus();
}

}  // namespace lambert::server
