#include "app/measures_text.h"

#include <array>
#include <utility>

#include "fmt/format.h"
#include "nlohmann/json.hpp"

namespace lambert::app {
namespace {

struct Row {
  const char* name;
  std::optional<double> value;
  const char* meaning;
};

std::array<Row, 5> Rows(const ErrorMeasures& measures) {
  return {{{"rms_area", measures.rms_area, "RMS error weighted by area, over the mean reflected"},
           {"rms_patch", measures.rms_patch, "RMS error, every patch alike"},
           {"rms_local", measures.rms_local, "RMS error of the region, over its own mean"},
           {"p95", measures.p95, "95 % of the patches are nearer than this, relative"},
           {"power_bias", measures.power_bias, "reflected flux over the reference's, minus 1"}}};
}

}  // namespace

std::string MeasuresText(const ErrorMeasures& measures) {
  std::string text;
  for (const Row& row : Rows(measures)) {
    text += fmt::format("{:<11}{:<24}{}\n", row.name,
                        row.value ? fmt::format("{}", *row.value) : "-", row.meaning);
  }
  return text;
}

nlohmann::ordered_json MeasuresJson(const ErrorMeasures& measures) {
  nlohmann::ordered_json json;
  for (const Row& row : Rows(measures)) {
    json[row.name] =
        row.value ? nlohmann::ordered_json(*row.value) : nlohmann::ordered_json(nullptr);
  }
  return json;
}

}  // namespace lambert::app
