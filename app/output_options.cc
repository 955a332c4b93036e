#include "app/option_checks.h"
#include "app/option_groups.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

constexpr char kLightmap[] = "Lightmap";

}  // namespace

void AddOutputOptions(CLI::App& command, Draft& draft) {
  command
      .add_option("-o,--out", draft.options.out_folder, "folder for the result; made if need be")
      ->option_text("DIR");
  OutputFiles& files = draft.options.outputs;
  command
      .add_option_function<std::vector<std::string>>(
          "--outputs",
          [&files](const std::vector<std::string>& names) {
            const auto asked = [&names](const char* name) {
              return std::find(names.begin(), names.end(), name) != names.end();
            };
            files = {asked("csv"), asked("glb"), asked("exr"), asked("png"), asked("report")};
          },
          "files beside run.json and convergence.csv, by commas (csv,glb,exr,png,report)")
      ->option_text("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(OneOf({"csv", "glb", "exr", "png", "report"}));
  command
      .add_option("--final-gather", draft.final_gather_rays,
                  "gather light at each pixel, vertex and texel, rays a point; 0: none (0; 64 at "
                  "--quality final)")
      ->option_text("RAYS")
      ->transform(CountFrom(0, kMaxGatherRays));
  command
      .add_option("--sensors", draft.options.sensors_path,
                  "points or grids (.csv, .json) where illuminance is gathered: sensors.csv, .json")
      ->option_text("FILE");
  command
      .add_option("--work-plane", draft.options.work_plane_m,
                  "a grid of sensors over each floor, so many metres above it (EN 12464-1)")
      ->option_text("HEIGHT")
      ->check(NumberFrom(0));
}

void AddLightmapOptions(CLI::App& command, Draft& draft) {
  LightmapOptions& lightmap = draft.options.lightmap_options;
  command
      .add_flag("--lightmap", draft.options.lightmap,
                "an atlas on TEXCOORD_1: NAME.lightmapped.glb, NAME.irradiance.exr,\n"
                "NAME.lightmap.json")
      ->group(kLightmap);
  command
      .add_option("--texels-per-meter", lightmap.texels_per_meter,
                  fmt::format("density (absent: {}, or less so that all surfaces take {} texels)",
                              kDefaultDensity, kDefaultTexels))
      ->option_text("D")
      ->check(NumberFrom(1e-6, 1e6))
      ->group(kLightmap);
  command
      .add_option("--lightmap-page", lightmap.largest_page,
                  fmt::format("largest side of a page, texels ({})", kLargestPage))
      ->option_text("N")
      ->check(OneOf({"256", "512", "1024", "2048", "4096"}))
      ->group(kLightmap);
}
}  // namespace lambert::app
