#include "server/jobs/spec.h"

#include <algorithm>

#include "radiosity/core/error.h"
#include "radiosity/shoot/settings.h"

namespace lambert::server {
namespace {

PatchOptions DecodePatch(const v1::PatchSpec& spec, int64_t max_patches) {
  PatchOptions options;
  options.max_edge_m = spec.max_edge_meters();
  options.two_sided = spec.two_sided();
  options.emission_unit = spec.emission_unit() == v1::PatchSpec::EMISSION_UNIT_WATT
                              ? EmissionUnit::kWattPerM2PerSr
                              : EmissionUnit::kNit;
  if (spec.has_meters_per_unit()) options.metres_per_unit = spec.meters_per_unit();
  if (spec.blend() == v1::PatchSpec::BLEND_OMIT) options.blend = Blend::kOmit;
  if (spec.has_max_patch_count()) options.max_patches = spec.max_patch_count();
  options.max_patches = std::min(options.max_patches, max_patches);
  options.adapt_patches = spec.adapt_patch_count();
  options.lights.sky = spec.lights().sky();
  options.lights.sky_illuminance_lx = spec.lights().sky_illuminance_lux();
  options.lights.sun_azimuth_deg = spec.lights().sun_azimuth_degrees();
  options.lights.sun_elevation_deg = spec.lights().sun_elevation_degrees();
  options.lights.sun_illuminance_lx = spec.lights().sun_illuminance_lux();
  for (const v1::LightSpec::Lamp& lamp : spec.lights().lamps()) {
    options.lights.lamps.push_back({lamp.file(), lamp.node()});
  }
  return options;
}

}  // namespace

absl::StatusOr<JobOptions> DecodeSpec(const v1::SolveSpec& spec, int64_t max_patches) {
  JobOptions options;
  options.patch = DecodePatch(spec.patch(), max_patches);
  SolveOptions& solve = options.solve;
  solve.shoot.method = Method::kAuto;
  if (!spec.shoot().method().empty()) {
    absl::StatusOr<Method> method = ParseMethod(spec.shoot().method());
    if (!method.ok()) return method.status();
    solve.shoot.method = *method;
  }
  for (const auto& [name, value] : spec.shoot().settings()) {
    absl::Status applied = ApplySetting(name, value, solve.shoot);
    if (!applied.ok()) return applied;
  }
  solve.shoot.region.assign(spec.shoot().region().begin(), spec.shoot().region().end());
  if (spec.has_seed()) solve.seed = static_cast<uint64_t>(spec.seed());
  solve.max_error = spec.max_error();
  solve.max_rays = spec.max_ray_count();
  solve.max_time_s = spec.max_seconds();
  if (spec.has_unsent_tolerance()) solve.unsent_tolerance = spec.unsent_tolerance();
  if (spec.has_max_step_count()) solve.max_steps = spec.max_step_count();
  if (absl::Status status = options.patch.Validate(); !status.ok()) return status;
  if (absl::Status status = solve.Validate(); !status.ok()) return status;
  if (absl::Status status = solve.shoot.Validate(); !status.ok()) return status;
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
