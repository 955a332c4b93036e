// ReadSensors: grids as JSON, points as CSV.
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "radiosity/core/error.h"
#include "radiosity/output/sensors.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

constexpr size_t kMostSensors = 1'000'000;

absl::Status Invalid(const std::string& where, const std::string& what) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SENSORS_INVALID", where, what, "see docs/formats.md, sensors"});
}

// Adds a sensor. False where the normal has no direction, or something is not finite.
bool Add(Vec3 position, Vec3 normal, SensorGrid& grid) {
  const double length = Length(normal);
  if (!IsFinite(position) || !std::isfinite(length) || length == 0) return false;
  grid.position_m.push_back(position);
  grid.normal.push_back(normal / length);
  return true;
}

bool ReadVec3(const Json& json, Vec3& v) {
  if (!json.is_array() || json.size() != 3) return false;
  for (const Json& number : json) {
    if (!number.is_number()) return false;
  }
  v = {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
  return IsFinite(v);
}

absl::StatusOr<SensorGrid> ReadGrid(const std::string& where, const Json& json) {
  Vec3 origin, u, v;
  if (!json.is_object() || !ReadVec3(json.value("origin", Json()), origin) ||
      !ReadVec3(json.value("u", Json()), u) || !ReadVec3(json.value("v", Json()), v)) {
    return Invalid(where, "origin, u and v are not three numbers each");
  }
  const double width = Length(u), depth = Length(v);
  Vec3 normal = Cross(u, v);
  if (!(Length(normal) > 0)) return Invalid(where, "u and v span no area");
  if (json.contains("normal") && !ReadVec3(json["normal"], normal)) {
    return Invalid(where, "normal is not three numbers");
  }
  double spacing = GridSpacing(width, depth);
  if (json.contains("spacing")) {
    if (!json["spacing"].is_number()) return Invalid(where, "spacing is no number");
    spacing = json["spacing"].get<double>();
    if (!(spacing > 0)) return Invalid(where, "spacing is not > 0");
  }
  if (width / spacing * (depth / spacing) > kMostSensors) {
    return Invalid(where, "more than 1,000,000 sensors");
  }
  SensorGrid grid;
  const int columns = PointsAlong(width, spacing), rows = PointsAlong(depth, spacing);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 at = origin + u * ((column + 0.5) / columns) + v * ((row + 0.5) / rows);
      if (!Add(at, normal, grid)) return Invalid(where, "the normal has no direction");
    }
  }
  return grid;
}

absl::StatusOr<std::vector<SensorGrid>> ReadJson(const std::string& path, const std::string& text) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (json.is_discarded() || !json.is_object() || !json.value("grids", Json()).is_array()) {
    return Invalid(path, "it is no JSON object with a list 'grids'");
  }
  std::vector<SensorGrid> grids;
  for (const Json& one : json["grids"]) {
    const std::string number = std::to_string(grids.size());
    absl::StatusOr<SensorGrid> grid = ReadGrid(path + ", grid " + number, one);
    if (!grid.ok()) return grid.status();
    const Json name = one.value("name", Json());
    grid->name = name.is_string() ? name.get<std::string>() : "grid " + number;
    grids.push_back(*std::move(grid));
  }
  if (grids.empty()) return Invalid(path, "it has no grid");
  return grids;
}

std::vector<std::string> Fields(std::string line) {
  std::erase_if(line, [](char c) { return c == '\r' || c == ' '; });
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

absl::StatusOr<std::vector<SensorGrid>> ReadTable(const std::string& path,
                                                  const std::string& text) {
  std::stringstream lines(text);
  std::string line;
  std::getline(lines, line);
  std::map<std::string, size_t> columns;
  for (const std::string& name : Fields(line)) columns.emplace(name, columns.size());
  for (const char* name : {"x", "y", "z"}) {
    if (columns.count(name) == 0) {
      return Invalid(path + ", line 1", "column '" + std::string(name) + "' is missing");
    }
  }
  std::map<std::string, SensorGrid> grids;
  size_t count = 0;
  for (int number = 2; std::getline(lines, line); ++number) {
    const std::vector<std::string> fields = Fields(line);
    if (fields.empty()) continue;
    const std::string where = path + ", line " + std::to_string(number);
    if (++count > kMostSensors) return Invalid(where, "more than 1,000,000 sensors");
    bool is_good = true;
    const auto value = [&](const char* name, double otherwise) {
      const auto column = columns.find(name);
      if (column == columns.end()) return otherwise;
      if (column->second >= fields.size()) return is_good = false, 0.0;
      const std::string& field = fields[column->second];
      double read = 0;
      const auto end = std::from_chars(field.data(), field.data() + field.size(), read);
      is_good = is_good && end.ec == std::errc() && end.ptr == field.data() + field.size();
      return read;
    };
    const Vec3 position{value("x", 0), value("y", 0), value("z", 0)};
    const Vec3 normal{value("nx", 0), value("ny", 1), value("nz", 0)};
    const auto column = columns.find("grid");
    const bool has_name = column != columns.end() && column->second < fields.size();
    SensorGrid& grid = grids[has_name ? fields[column->second] : "points"];
    if (!is_good || !Add(position, normal, grid)) {
      return Invalid(where, "these are not a position and a direction");
    }
  }
  std::vector<SensorGrid> list;
  for (auto& [name, grid] : grids) {
    grid.name = name;
    list.push_back(std::move(grid));
  }
  if (list.empty()) return Invalid(path, "it has no sensor");
  return list;
}

}  // namespace

absl::StatusOr<std::vector<SensorGrid>> ReadSensors(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad()) {
    return MakeError(absl::StatusCode::kNotFound,
                     {"FILE_NOT_FOUND", path, "it cannot be read", "give a .json or .csv file"});
  }
  return path.ends_with(".json") ? ReadJson(path, text) : ReadTable(path, text);
}

}  // namespace lambert
