#include "client/convert.h"

#include "client/status.h"
#include "net/solve_spec.h"

namespace lambert::client {
namespace {

JobState StateFromProto(v1::SolveJob::State state) {
  switch (state) {
    case v1::SolveJob::STATE_RUNNING:
      return JobState::kRunning;
    case v1::SolveJob::STATE_SUCCEEDED:
      return JobState::kSucceeded;
    case v1::SolveJob::STATE_FAILED:
      return JobState::kFailed;
    case v1::SolveJob::STATE_CANCELLED:
      return JobState::kCancelled;
    default:
      return JobState::kQueued;
  }
}

StopReason StopReasonFromProto(v1::SolveJob::StopReason reason) {
  switch (reason) {
    case v1::SolveJob::STOP_REASON_ERROR_REACHED:
      return StopReason::kErrorReached;
    case v1::SolveJob::STOP_REASON_RAYS_SPENT:
      return StopReason::kRaysSpent;
    case v1::SolveJob::STOP_REASON_TIME_SPENT:
      return StopReason::kTimeSpent;
    case v1::SolveJob::STOP_REASON_NOTHING_TO_SHOOT:
      return StopReason::kNothingToShoot;
    default:
      return StopReason::kNone;
  }
}

}  // namespace

Progress FromProto(const v1::Progress& progress) {
  return {.pass = progress.pass(),
          .step = progress.step(),
          .rays = progress.ray_count(),
          .seconds = progress.seconds(),
          .cpu_seconds = progress.cpu_seconds(),
          .unsent_fraction = progress.unsent_fraction(),
          .estimated_rms_area = progress.estimated_rms_area(),
          .estimated_rms_patch = progress.estimated_rms_patch(),
          .wanted_rms_area = progress.wanted_rms_area(),
          .max_rays = progress.max_ray_count(),
          .pilot = progress.pilot(),
          .pilot_patches = progress.pilot_patch_count()};
}

Plan FromProto(const v1::Plan& plan) {
  Plan result;
  PatchOptions patch;  // not part of a plan
  (void)ReadSpec(plan.spec(), patch, result.options);
  for (const v1::PlanItem& item : plan.items()) {
    result.items.push_back(
        {item.part(), item.item(), item.left_out(), item.forced(), item.reason(), item.saving()});
  }
  result.patches = plan.patch_count();
  result.worker_bytes = plan.worker_size_bytes();
  result.first_pass_rays = plan.first_pass_ray_count();
  return result;
}

Meshing FromProto(const v1::Meshing& meshing) {
  return {meshing.coarse_patch_count(), meshing.pilot_count(), meshing.pilot_ray_count(),
          meshing.predicted_rms_area(), meshing.seconds(),     meshing.reason()};
}

BlobRef FromProto(const v1::Digest& digest) { return {digest.sha256(), digest.size_bytes()}; }

Job FromProto(const v1::SolveJob& job) {
  Job result;
  result.name = job.name();
  result.scene = job.scene();
  result.scene_name = job.scene_display_name();
  result.state = StateFromProto(job.state());
  result.stop_reason = StopReasonFromProto(job.stop_reason());
  result.reached_goal = job.reached_goal();
  if (job.has_error()) result.error = FromRpcStatus(job.error(), job.name());
  for (const v1::Warning& warning : job.warnings()) {
    result.warnings.push_back({warning.reason(), warning.message()});
  }
  (void)ReadSpec(job.spec(), result.patch_options, result.solve_options);
  if (job.has_plan()) result.plan = FromProto(job.plan());
  if (job.has_meshing()) result.meshing = FromProto(job.meshing());
  result.patch_set = FromProto(job.patch_set_digest());
  result.progress = FromProto(job.progress());
  result.snapshot_version = job.latest_snapshot().version();
  result.snapshot_progress = FromProto(job.latest_snapshot().progress());
  result.snapshot = FromProto(job.latest_snapshot().payload_digest());
  result.unit_version = job.unit_version();
  return result;
}

Worker FromProto(const v1::Worker& worker) {
  return {worker.name(), worker.slot_count(), worker.lease_count(), worker.finished_unit_count(),
          worker.silence_seconds()};
}

const char* JobStateName(JobState state) {
  static constexpr const char* kNames[] = {"queued", "running", "succeeded", "failed", "cancelled"};
  return kNames[static_cast<int>(state)];
}

}  // namespace lambert::client
