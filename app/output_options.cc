#include <cmath>

#include "absl/strings/numbers.h"
#include "app/option_checks.h"
#include "app/option_groups.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

constexpr char kLightmap[] = "Lightmap";
constexpr char kPicture[] = "Picture";
constexpr double kMostEv = 100;  // either way; sunlit snow is 16, starlight -8

void AddPictureOptions(CLI::App& command, Draft& draft) {
  PictureOptions& picture = draft.options.picture;
  command
      .add_option_function<std::string>(
          "--tone-map",
          [&picture](const std::string& name) {
            picture.tone_map = name == "linear" ? ToneMap::kLinear : ToneMap::kFilmic;
          },
          "of the picture and the colours of the GLB: filmic (default: highlights are rolled off)\n"
          "or linear (cut off at white)")
      ->option_text("NAME")
      ->check(OneOf({"filmic", "linear"}))
      ->group(kPicture);
  command
      .add_option_function<std::string>(
          "--exposure",
          [&picture](const std::string& text) {
            double ev100 = 0;
            const bool is_number = absl::SimpleAtod(text, &ev100);
            picture.exposure_per_lm_per_m2 = is_number ? ExposureOfEv100(ev100) : 0;
          },
          "exposure value at ISO 100: white is 1.2 * 2^EV cd/m2; auto (default): from the picture")
      ->option_text("EV")
      ->check(Check([](std::string& text) -> std::string {
        double ev100 = 0;
        if (text == "auto" || (absl::SimpleAtod(text, &ev100) && std::abs(ev100) <= kMostEv)) {
          return "";
        }
        return fmt::format("'{}' is neither auto nor a number from -{} to {}", text, kMostEv,
                           kMostEv);
      }))
      ->group(kPicture);
}

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
  AddPictureOptions(command, draft);
}

void AddLightmapOptions(CLI::App& command, Draft& draft) {
  LightmapOptions& lightmap = draft.options.lightmap_options;
  command
      .add_flag("--lightmap", draft.options.lightmap,
                "an atlas on TEXCOORD_1: NAME.lightmapped.glb, NAME.lit.glb,\n"
                "NAME.irradiance.exr, NAME.lightmap.json")
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
