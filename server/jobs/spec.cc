#include "server/jobs/spec.h"

#include <algorithm>

#include "net/solve_spec.h"

namespace lambert::server {
absl::StatusOr<JobOptions> DecodeSpec(const v1::SolveSpec& spec, int64_t max_patches) {
  JobOptions options;
  if (absl::Status status = ReadSpec(spec, options.patch, options.solve); !status.ok()) {
    return status;
  }
  options.patch.max_patches = std::min(options.patch.max_patches, max_patches);
  if (absl::Status status = options.patch.Validate(); !status.ok()) return status;
  if (absl::Status status = options.solve.Validate(); !status.ok()) return status;
  if (absl::Status status = options.solve.shoot.Validate(); !status.ok()) return status;
  return options;
}

v1::Plan EncodePlan(const Plan& plan, const v1::SolveSpec& asked) {
  v1::Plan proto;
  v1::SolveSpec& spec = *proto.mutable_spec();
  spec = asked;
  spec.mutable_shoot()->set_method(MethodName(plan.options.shoot.method));
  spec.set_seed(static_cast<int64_t>(plan.options.seed));
  spec.set_max_error(plan.options.max_error);
  spec.set_max_ray_count(plan.options.max_rays);
  spec.set_max_seconds(plan.options.max_time_s);
  for (const PlanItem& item : plan.items) {
    v1::PlanItem* added = proto.add_items();
    added->set_item(item.item);
    added->set_left_out(item.left_out);
    added->set_reason(item.reason);
    added->set_saving(item.saving);
    added->set_part(item.part);
    added->set_forced(item.forced);
  }
  proto.set_patch_count(plan.patches);
  proto.set_worker_size_bytes(plan.worker_bytes);
  proto.set_first_pass_ray_count(plan.first_pass_rays);
  return proto;
}

v1::Progress EncodeProgress(const Progress& progress) {
  v1::Progress proto;
  proto.set_pass(progress.pass);
  proto.set_step(progress.step);
  proto.set_ray_count(progress.rays);
  proto.set_seconds(progress.seconds);
  proto.set_cpu_seconds(progress.cpu_seconds);
  proto.set_unsent_fraction(progress.unsent_fraction);
  proto.set_estimated_rms_area(progress.estimated_rms_area);
  proto.set_estimated_rms_patch(progress.estimated_rms_patch);
  proto.set_wanted_rms_area(progress.wanted_rms_area);
  proto.set_max_ray_count(progress.max_rays);
  proto.set_pilot(progress.pilot);
  proto.set_pilot_patch_count(progress.pilot_patches);
  return proto;
}

v1::Meshing EncodeMeshing(const Meshing& meshing) {
  v1::Meshing proto;
  proto.set_coarse_patch_count(meshing.coarse_patches);
  proto.set_pilot_count(meshing.pilots);
  proto.set_pilot_ray_count(meshing.pilot_rays);
  proto.set_predicted_rms_area(meshing.predicted_error);
  proto.set_seconds(meshing.seconds);
  proto.set_reason(meshing.reason);
  return proto;
}

Meshing DecodeMeshing(const v1::Meshing& proto) {
  return {proto.coarse_patch_count(), proto.pilot_count(), proto.pilot_ray_count(),
          proto.predicted_rms_area(), proto.seconds(),     proto.reason()};
}

v1::Warning EncodeWarning(const Warning& warning) {
  v1::Warning proto;
  proto.set_reason(warning.reason);
  proto.set_message(warning.message);
  return proto;
}

v1::SolveJob::StopReason EncodeStopReason(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return v1::SolveJob::STOP_REASON_UNSPECIFIED;
    case StopReason::kErrorReached:
      return v1::SolveJob::STOP_REASON_ERROR_REACHED;
    case StopReason::kRaysSpent:
      return v1::SolveJob::STOP_REASON_RAYS_SPENT;
    case StopReason::kTimeSpent:
      return v1::SolveJob::STOP_REASON_TIME_SPENT;
    case StopReason::kNothingToShoot:
      return v1::SolveJob::STOP_REASON_NOTHING_TO_SHOOT;
  }
  return v1::SolveJob::STOP_REASON_UNSPECIFIED;
}

}  // namespace lambert::server
