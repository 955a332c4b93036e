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
  absl::StatusOr<PatchSet> patches = BuildPatches(*scene, options.patch);
  if (!patches.ok()) return patches.status();
  if (absl::Status stored = Store(*patches); !stored.ok()) return stored;
  return std::make_shared<const PatchSet>(*std::move(patches));
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
  Meshing meshing;
  const auto run = [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
                       int32_t) { return RunPilot(patches, pilot, meshing); };
  absl::StatusOr<std::shared_ptr<const PatchSet>> patches =
      AdaptMesh(scene, options.patch, options.solve, run, &meshing);
  if (!patches.ok()) return patches.status();
  meshing.seconds = ToSeconds(parts_.clock() - began);
  if (absl::Status stored = Store(**patches); !stored.ok()) return stored;
  job_.Update([&](v1::SolveJob& record) { *record.mutable_meshing() = EncodeMeshing(meshing); });
  return patches;
}

absl::StatusOr<Solution> PatchMaker::RunPilot(const std::shared_ptr<const PatchSet>& patches,
                                              const SolveOptions& pilot, Meshing& meshing) {
  if (absl::Status stored = Store(*patches); !stored.ok()) return stored;
  const Plan plan = MakePlan(*patches, pilot);
  Solver solver(patches, plan.options,
                [this] { return ToSeconds(parts_.clock().time_since_epoch()); });
  JobSteps steps(parts_, job_, journal_, patches->size(), plan.options.shoot, {});
  const auto on_step = [&](Progress progress) {
    progress.pilot = meshing.pilots;
    progress.pilot_patches = patches->size();
    steps.OnStep(progress);
  };
  while (solver.stop_reason() == StopReason::kNone) {
    if (absl::Status status = solver.RunPass(steps.executor(), on_step); !status.ok()) {
      return status;
    }
  }
  const Snapshot snapshot = solver.MakeSnapshot();
  meshing.pilot_rays += snapshot.progress.rays;
  return *snapshot.solution;
}

absl::Status PatchMaker::Store(const PatchSet& patches) {
  std::string bytes = EncodePatchSet(patches);
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
  return absl::OkStatus();
}

}  // namespace lambert::server
