#include "client/convert.h"

#include "client/status.h"
#include "radiosity/shoot/settings.h"

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

void FromProto(const v1::PatchSpec& spec, PatchOptions& options) {
  options.max_edge_m = spec.max_edge_meters();
  options.two_sided = spec.two_sided();
  options.emission_unit = spec.emission_unit() == v1::PatchSpec::EMISSION_UNIT_WATT
                              ? EmissionUnit::kWattPerM2PerSr
                              : EmissionUnit::kNit;
  if (spec.has_meters_per_unit()) options.metres_per_unit = spec.meters_per_unit();
  options.blend = spec.blend() == v1::PatchSpec::BLEND_OMIT ? Blend::kOmit : Blend::kOpaque;
  if (spec.has_max_patch_count()) options.max_patches = spec.max_patch_count();
  options.adapt_patches = spec.adapt_patch_count();
  options.lights.sky = spec.lights().sky();
  options.lights.sky_illuminance_lx = spec.lights().sky_illuminance_lux();
  options.lights.sun_azimuth_deg = spec.lights().sun_azimuth_degrees();
  options.lights.sun_elevation_deg = spec.lights().sun_elevation_degrees();
  options.lights.sun_illuminance_lx = spec.lights().sun_illuminance_lux();
  options.lights.lamps.clear();
  for (const v1::LightSpec::Lamp& lamp : spec.lights().lamps()) {
    options.lights.lamps.push_back({lamp.file(), lamp.node()});
  }
}

void ToProto(const LightOptions& lights, v1::LightSpec& spec) {
  spec.set_sky(lights.sky);
  spec.set_sky_illuminance_lux(lights.sky_illuminance_lx);
  spec.set_sun_azimuth_degrees(lights.sun_azimuth_deg);
  spec.set_sun_elevation_degrees(lights.sun_elevation_deg);
  spec.set_sun_illuminance_lux(lights.sun_illuminance_lx);
  for (const LightOptions::Lamp& lamp : lights.lamps) {
    v1::LightSpec::Lamp* added = spec.add_lamps();
    added->set_file(lamp.file);
    added->set_node(lamp.node);
  }
}

}  // namespace

v1::SolveSpec ToProto(const PatchOptions& patch, const SolveOptions& solve) {
  v1::SolveSpec spec;
  spec.mutable_patch()->set_max_edge_meters(patch.max_edge_m);
  spec.mutable_patch()->set_two_sided(patch.two_sided);
  spec.mutable_patch()->set_emission_unit(patch.emission_unit == EmissionUnit::kNit
                                              ? v1::PatchSpec::EMISSION_UNIT_NIT
                                              : v1::PatchSpec::EMISSION_UNIT_WATT);
  spec.mutable_patch()->set_meters_per_unit(patch.metres_per_unit);
  spec.mutable_patch()->set_blend(patch.blend == Blend::kOmit ? v1::PatchSpec::BLEND_OMIT
                                                              : v1::PatchSpec::BLEND_OPAQUE);
  spec.mutable_patch()->set_max_patch_count(patch.max_patches);
  spec.mutable_patch()->set_adapt_patch_count(patch.adapt_patches);
  ToProto(patch.lights, *spec.mutable_patch()->mutable_lights());
  spec.mutable_shoot()->set_method(MethodName(solve.shoot.method));
  for (const auto& [name, value] : ChangedSettings(solve.shoot)) {
    (*spec.mutable_shoot()->mutable_settings())[name] = value;
  }
  for (const std::string& node : solve.shoot.region) spec.mutable_shoot()->add_region(node);
  spec.set_seed(static_cast<int64_t>(solve.seed));
  spec.set_max_error(solve.max_error);
  spec.set_max_ray_count(solve.max_rays);
  spec.set_max_seconds(solve.max_time_s);
  spec.set_unsent_tolerance(solve.unsent_tolerance);
  spec.set_max_step_count(solve.max_steps);
  return spec;
}

void FromProto(const v1::SolveSpec& spec, PatchOptions& patch, SolveOptions& solve) {
  FromProto(spec.patch(), patch);
  solve.shoot.method = ParseMethod(spec.shoot().method()).value_or(Method::kAuto);
  for (const auto& [name, value] : spec.shoot().settings()) {
    // A setting that this program does not know changes nothing that it shows.
    (void)ApplySetting(name, value, solve.shoot);
  }
  solve.shoot.region.assign(spec.shoot().region().begin(), spec.shoot().region().end());
  if (spec.has_seed()) solve.seed = static_cast<uint64_t>(spec.seed());
  solve.max_error = spec.max_error();
  solve.max_rays = spec.max_ray_count();
  solve.max_time_s = spec.max_seconds();
  if (spec.has_unsent_tolerance()) solve.unsent_tolerance = spec.unsent_tolerance();
  if (spec.has_max_step_count()) solve.max_steps = spec.max_step_count();
}

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
  FromProto(plan.spec(), patch, result.options);
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
  FromProto(job.spec(), result.patch_options, result.solve_options);
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
