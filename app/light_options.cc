#include "app/light_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "app/option_checks.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

constexpr char kLights[] = "Lights beside those of the scene";

bool IsNamed(const std::string& sky) { return sky == "uniform" || sky == "overcast"; }

bool EndsIn(const std::string& path, const std::string& ending) {
  std::string own = std::filesystem::path(path).extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return own == ending;
}

// "AZIMUTH,ELEVATION" or "AZIMUTH,ELEVATION,LUX"; nullopt for anything else.
std::optional<std::vector<double>> ParseSun(const std::string& text) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (error != std::errc() || stop != text.data() + end) return std::nullopt;
    numbers.push_back(number);
    begin = end + 1;
  }
  if (numbers.size() == 2) numbers.push_back(kSunIlluminance_lx);
  const bool is_sun = numbers.size() == 3 && std::fabs(numbers[0]) <= 360 &&
                      std::fabs(numbers[1]) <= 90 && numbers[2] >= 0 && numbers[2] <= 1e15;
  return is_sun ? std::optional(numbers) : std::nullopt;
}

// Where "FILE=NODE" parts; nodes may hold a =, files of lamps end before it.
size_t LampSplit(const std::string& text) {
  for (size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    if (EndsIn(text.substr(0, at), ".ies") && at + 1 < text.size()) return at;
  }
  return std::string::npos;
}

}  // namespace

void AddLightOptions(CLI::App& command, Draft& draft) {
  Options& options = draft.options;
  LightOptions& lights = options.patch.lights;
  command
      .add_option_function<std::string>(
          "--sky",
          [&options, &lights](const std::string& sky) {
            options.sky_path = IsNamed(sky) ? "" : sky;
            lights.sky = IsNamed(sky) ? sky : std::filesystem::path(sky).filename().string();
          },
          "uniform, overcast (CIE), or FILE.exr, a lat-long picture in nit with +x in its middle")
      ->option_text("NAME")
      ->check(Check([](std::string& text) -> std::string {
        if (IsNamed(text) || EndsIn(text, ".exr")) return "";
        return fmt::format("'{}' is not uniform, overcast or a FILE.exr", text);
      }))
      ->group(kLights);
  command
      .add_option("--sky-illuminance", lights.sky_illuminance_lx,
                  "horizontal illuminance of the sky, lux (10,000; absent: FILE.exr as it is)")
      ->option_text("LX")
      ->check(NumberFrom(0, 1e15))
      ->group(kLights);
  command
      .add_option_function<std::string>(
          "--sun",
          [&lights](const std::string& text) {
            const std::vector<double> numbers = *ParseSun(text);
            lights.sun_azimuth_deg = numbers[0];
            lights.sun_elevation_deg = numbers[1];
            lights.sun_illuminance_lx = numbers[2];
          },
          "azimuth clockwise from north (-z; east is +x) and elevation, degrees; illuminance of a\n"
          "surface that faces it, lux (100,000)")
      ->option_text("AZIMUTH,ELEVATION[,LX]")
      ->check(Check([](std::string& text) -> std::string {
        if (ParseSun(text)) return "";
        return fmt::format("'{}' is not an azimuth, an elevation and lux", text);
      }))
      ->group(kLights);
  command
      .add_option_function<std::vector<std::string>>(
          "--ies",
          [&options, &lights](const std::vector<std::string>& texts) {
            options.ies_paths.clear();
            lights.lamps.clear();
            for (const std::string& text : texts) {
              const size_t at = LampSplit(text);
              const std::string path = text.substr(0, at);
              auto& paths = options.ies_paths;
              if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
              lights.lamps.push_back(
                  {std::filesystem::path(path).filename().string(), text.substr(at + 1)});
            }
          },
          "a photometric file (LM-63) for the lamp at a node, by name or index; may be repeated")
      ->option_text("FILE.ies=NODE")
      ->allow_extra_args(false)
      ->check(Check([](std::string& text) -> std::string {
        if (LampSplit(text) != std::string::npos) return "";
        return fmt::format("'{}' is not FILE.ies=NODE", text);
      }))
      ->group(kLights);
}

}  // namespace lambert::app
