#include "radiosity/output/run_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "radiosity/shoot/settings.h"

namespace lambert {
namespace {

using Json = nlohmann::ordered_json;

Json RgbJson(Rgb value) { return {value.r, value.g, value.b}; }

Json KnownOrNull(double estimate) { return estimate < 0 ? Json(nullptr) : Json(estimate); }

Json LightsJson(const LightOptions& lights) {
  Json lamps = Json::array();
  for (const LightOptions::Lamp& lamp : lights.lamps) {
    lamps.push_back({{"file", lamp.file}, {"node", lamp.node}});
  }
  return {{"sky", lights.sky},
          {"sky_illuminance_lx", lights.sky_illuminance_lx},
          {"sun_azimuth_deg", lights.sun_azimuth_deg},
          {"sun_elevation_deg", lights.sun_elevation_deg},
          {"sun_illuminance_lx", lights.sun_illuminance_lx},
          {"ies", lamps}};
}

Json OptionsJson(const SolveOptions& solve, const PatchOptions& patch) {
  Json json{{"method", MethodName(solve.shoot.method)},
            {"seed", solve.seed},
            {"max_error", solve.max_error},
            {"max_rays", solve.max_rays},
            {"max_time_s", solve.max_time_s},
            {"unsent_tolerance", solve.unsent_tolerance},
            {"max_steps", solve.max_steps},
            {"region", solve.shoot.region}};
  json.update(PatchOptionsJson(patch));
  for (const ShootSetting& setting : ShootSettings()) {
    std::string key = setting.name;
    std::replace(key.begin(), key.end(), '-', '_');
    json[key] = setting.get(solve.shoot);
  }
  return json;
}

Json PlanJson(const Plan& plan) {
  return {{"patches", plan.patches},
          {"worker_bytes", plan.worker_bytes},
          {"first_pass_rays", plan.first_pass_rays},
          {"items", PlanItemsJson(plan)}};
}

Json MeshingJson(const Meshing& meshing) {
  return {{"coarse_patches", meshing.coarse_patches},
          {"pilots", meshing.pilots},
          {"pilot_rays", meshing.pilot_rays},
          {"predicted_rms_area", KnownOrNull(meshing.predicted_error)},
          {"seconds", meshing.seconds},
          {"reason", meshing.reason}};
}

Json LedgerJson(const Ledger& ledger, const char* unit) {
  return {{"unit", unit},
          {"emitted", RgbJson(ledger.emitted)},
          {"absorbed", RgbJson(ledger.absorbed)},
          {"escaped", RgbJson(ledger.escaped)},
          {"unsent", RgbJson(ledger.unsent)},
          {"residual", RgbJson(ledger.residual)}};
}

Json TotalsJson(const RunRecord& record) {
  const Progress& progress = record.snapshot.progress;
  double area = 0;
  for (double patch_area : record.patches->area_m2) area += patch_area;
  return {{"patches", record.patches->size()},
          {"area_m2", area},
          {"patches_never_hit", NeverHit(record).size()},
          {"passes", progress.pass},
          {"rays", progress.rays},
          {"seconds", progress.seconds},
          {"cpu_seconds", progress.cpu_seconds},
          {"unsent_fraction", progress.unsent_fraction},
          {"estimated_rms_area", KnownOrNull(progress.estimated_rms_area)},
          {"estimated_rms_patch", KnownOrNull(progress.estimated_rms_patch)},
          {"workers", record.workers},
          {"threads", record.threads}};
}

Json MeasuresJson(const ErrorMeasures& measures) {
  const auto value = [](std::optional<double> measure) {
    return measure.has_value() ? Json(*measure) : Json(nullptr);
  };
  return {{"rms_area", value(measures.rms_area)},
          {"rms_patch", value(measures.rms_patch)},
          {"rms_local", value(measures.rms_local)},
          {"p95", value(measures.p95)},
          {"power_bias", value(measures.power_bias)}};
}

Json PictureJson(const RunRecord& record, const PictureFacts& picture) {
  const View& view = picture.view;
  const Vec3 eye = record.patches->origin + view.eye;
  const Vec3 way = view.forward;
  return {{"view", view.origin},
          {"eye_m", {eye.x, eye.y, eye.z}},
          {"looks_along", {way.x, way.y, way.z}},
          {"exposure_by", record.picture_options.exposure_per_lm_per_m2 > 0 ? "option" : "auto"},
          {"exposure_per_lm_per_m2", picture.exposure.per_lm_per_m2},
          {"exposure_ev100", Ev100Of(picture.exposure.per_lm_per_m2)},
          {"tone_map", ToneMapName(picture.exposure.tone_map)}};
}

Json LightmapJson(const Atlas& atlas) {
  Json pages = Json::array();
  for (const PageSize& page : atlas.pages) pages.push_back({page.width, page.height});
  return {{"texels_per_meter", atlas.texels_per_meter}, {"pages", std::move(pages)}};
}

}  // namespace

Json PatchOptionsJson(const PatchOptions& options) {
  return {{"max_edge_m", options.max_edge_m},
          {"adapt_patches", options.adapt_patches},
          {"two_sided", options.two_sided},
          {"emission_unit", options.emission_unit == EmissionUnit::kNit ? "nit" : "W/m2/sr"},
          {"metres_per_unit", options.metres_per_unit},
          {"blend", options.blend == Blend::kOpaque ? "opaque" : "omit"},
          {"lights", LightsJson(options.lights)}};
}

Json PlanItemsJson(const Plan& plan) {
  Json items = Json::array();
  for (const PlanItem& item : plan.items) {
    items.push_back({{"part", item.part},
                     {"item", item.item},
                     {"left_out", item.left_out},
                     {"forced", item.forced},
                     {"reason", item.reason},
                     {"saving", item.saving}});
  }
  return items;
}

std::string EncodeRunJson(const RunRecord& record, const std::optional<PictureFacts>& picture) {
  Json json;
  json["name"] = record.name;
  json["scene_digest"] = record.scene_digest;
  json["method"] = MethodName(record.plan.options.shoot.method);
  json["seed"] = record.plan.options.seed;
  json["options"] = OptionsJson(record.plan.options, record.patch_options);
  json["stop_reason"] = record.interrupted ? "interrupted" : StopReasonName(record.stop_reason);
  json["versions"] = Json::object();
  for (const auto& [what, version] : record.versions) json["versions"][what] = version;
  json["pins"] = record.unit_version;
  json["plan"] = PlanJson(record.plan);
  if (record.meshing) json["meshing"] = MeshingJson(*record.meshing);
  json["ledger"] = LedgerJson(record.snapshot.solution->ledger,
                              UnitNamesOf(record.patch_options.emission_unit).flux);
  json["totals"] = TotalsJson(record);
  if (record.measures.has_value()) json["measures"] = MeasuresJson(*record.measures);
  json["timings_s"] = Json::object();
  for (const auto& [what, seconds] : record.timings_s) json["timings_s"][what] = seconds;
  json["final_gather_rays"] = record.final_gather_rays;
  json["picture"] = picture ? PictureJson(record, *picture) : Json(nullptr);
  json["lightmap"] = record.atlas ? LightmapJson(*record.atlas) : Json(nullptr);
  json["warnings"] = Json::array();
  std::vector<Warning> warnings = record.patches->warnings;
  if (record.atlas) {
    warnings.insert(warnings.end(), record.atlas->warnings.begin(), record.atlas->warnings.end());
  }
  for (const Warning& warning : warnings) {
    json["warnings"].push_back({{"reason", warning.reason}, {"message", warning.message}});
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lambert
