#include "net/solve_spec.h"

#include "lambert/v1/solve_spec.pb.h"
#include "radiosity/shoot/settings.h"

namespace lambert {
namespace {

void Read(const v1::PatchSpec& spec, PatchOptions& options) {
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

void Write(const LightOptions& lights, v1::LightSpec& spec) {
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

v1::SolveSpec MakeSpec(const PatchOptions& patch, const SolveOptions& solve) {
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
  Write(patch.lights, *spec.mutable_patch()->mutable_lights());
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

absl::Status ReadSpec(const v1::SolveSpec& spec, PatchOptions& patch, SolveOptions& solve) {
  absl::Status status;
  Read(spec.patch(), patch);
  solve.shoot.method = Method::kAuto;
  if (!spec.shoot().method().empty()) {
    const absl::StatusOr<Method> method = ParseMethod(spec.shoot().method());
    status.Update(method.status());
    solve.shoot.method = method.value_or(Method::kAuto);
  }
  for (const auto& [name, value] : spec.shoot().settings()) {
    status.Update(ApplySetting(name, value, solve.shoot));
  }
  solve.shoot.region.assign(spec.shoot().region().begin(), spec.shoot().region().end());
  if (spec.has_seed()) solve.seed = static_cast<uint64_t>(spec.seed());
  solve.max_error = spec.max_error();
  solve.max_rays = spec.max_ray_count();
  solve.max_time_s = spec.max_seconds();
  if (spec.has_unsent_tolerance()) solve.unsent_tolerance = spec.unsent_tolerance();
  if (spec.has_max_step_count()) solve.max_steps = spec.max_step_count();
  return status;
}

}  // namespace lambert
