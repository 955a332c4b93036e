#include "radiosity/output/patch_table.h"

#include <charconv>
#include <fstream>
#include <limits>
#include <string_view>

#include "radiosity/core/error.h"
#include "radiosity/output/number_text.h"
#include "radiosity/output/output_file.h"

namespace lambert {
namespace {

constexpr size_t kChunkBytes = 1 << 20;  // of text gathered before it is written
constexpr std::array<std::string_view, 15> kScalarColumns = {
    "patch", "node", "mesh", "primitive", "triangle", "area_m2", "x0", "y0",
    "z0",    "x1",   "y1",   "z1",        "x2",       "y2",      "z2"};
constexpr std::array<std::string_view, 5> kRgbColumns = {"reflectance", "exitance", "radiosity",
                                                         "irradiance", "std_error"};

std::vector<std::string> ColumnNames() {
  std::vector<std::string> names(kScalarColumns.begin(), kScalarColumns.end());
  for (std::string_view name : kRgbColumns) {
    for (const char* channel : {"_r", "_g", "_b"}) names.push_back(std::string(name) + channel);
  }
  return names;
}

void AppendColumn(double value, std::string& text) {
  text.push_back(',');
  AppendNumber(value, text);
}

void AppendColumns(Rgb value, std::string& text) {
  for (int channel = 0; channel < 3; ++channel) AppendColumn(value[channel], text);
}

void AppendLine(const PatchTable& table, PatchIndex i, std::string& text) {
  AppendNumber(i, text);
  const PatchSource& source = table.source[i];
  for (int32_t index : {source.node, source.mesh, source.primitive, source.triangle}) {
    text.push_back(',');
    AppendNumber(index, text);
  }
  AppendColumn(table.area_m2[i], text);
  for (const Vec3& corner : table.corners[i]) {
    for (double coordinate : {corner.x, corner.y, corner.z}) AppendColumn(coordinate, text);
  }
  for (const std::vector<Rgb>* column :
       {&table.reflectance, &table.exitance_lm_per_m2, &table.radiosity_lm_per_m2,
        &table.irradiance_lx, &table.std_error_lm_per_m2}) {
    AppendColumns((*column)[i], text);
  }
  text.push_back('\n');
}

// Splits at commas into as many fields as there are; a carriage return at the end is dropped.
void SplitLine(std::string_view line, std::vector<std::string_view>& fields) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  fields.clear();
  size_t begin = 0;
  for (size_t end = line.find(','); end != std::string_view::npos; end = line.find(',', begin)) {
    fields.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  fields.push_back(line.substr(begin));
}

absl::Status TableError(const std::string& path, int64_t line, const std::string& message) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"TABLE_INVALID", path + ", line " + std::to_string(line), message,
                    "give a patches.csv as 'lambert bake' writes it"});
}

// Puts the numbers of one line, in the order of ColumnNames, at the end of the table.
void AddRow(const std::vector<double>& values, PatchTable& table) {
  auto index = [&](int column) { return static_cast<int32_t>(values[column]); };
  table.source.push_back({index(1), index(2), index(3), index(4)});
  table.area_m2.push_back(values[5]);
  const double* v = values.data() + 6;
  table.corners.push_back({Vec3{v[0], v[1], v[2]}, Vec3{v[3], v[4], v[5]}, Vec3{v[6], v[7], v[8]}});
  v = values.data() + kScalarColumns.size();
  for (std::vector<Rgb>* column :
       {&table.reflectance, &table.exitance_lm_per_m2, &table.radiosity_lm_per_m2,
        &table.irradiance_lx, &table.std_error_lm_per_m2}) {
    column->push_back({v[0], v[1], v[2]});
    v += 3;
  }
}

// Where the columns of ColumnNames stand in a line that begins a file.
absl::StatusOr<std::vector<size_t>> FindColumns(const std::string& path,
                                                const std::vector<std::string>& names,
                                                const std::vector<std::string_view>& header) {
  std::vector<size_t> places;
  for (const std::string& name : names) {
    size_t place = 0;
    while (place < header.size() && header[place] != name) ++place;
    if (place == header.size()) return TableError(path, 1, "column '" + name + "' is missing");
    places.push_back(place);
  }
  return places;
}

// A finite number, or an index that fits where `is_index`.
bool ParseField(std::string_view field, bool is_index, double& value) {
  const auto result = std::from_chars(field.data(), field.data() + field.size(), value);
  if (result.ec != std::errc() || result.ptr != field.data() + field.size()) return false;
  if (!std::isfinite(value)) return false;
  return !is_index || std::abs(value) <= std::numeric_limits<int32_t>::max();
}

}  // namespace

PatchTable MakePatchTable(const PatchSet& patches, const Solution& solution) {
  PatchTable table;
  table.source = patches.source;
  table.area_m2 = patches.area_m2;
  table.corners = patches.corners;
  for (auto& triangle : table.corners) {
    for (Vec3& corner : triangle) corner = corner + patches.origin;
  }
  table.reflectance = patches.reflectance;
  table.exitance_lm_per_m2 = patches.exitance_lm_per_m2;
  table.radiosity_lm_per_m2 = solution.radiosity_lm_per_m2;
  table.irradiance_lx = solution.irradiance_lx;
  table.std_error_lm_per_m2 = solution.std_error_lm_per_m2;
  return table;
}

absl::Status WritePatchTable(const std::string& path, const PatchTable& table) {
  absl::StatusOr<OutputFile> file = OutputFile::Create(path);
  if (!file.ok()) return file.status();
  std::string text;
  for (const std::string& name : ColumnNames()) text += (text.empty() ? "" : ",") + name;
  text.push_back('\n');
  for (PatchIndex i = 0; i < table.size(); ++i) {
    AppendLine(table, i, text);
    if (text.size() < kChunkBytes) continue;
    if (absl::Status status = file->Append(text); !status.ok()) return status;
    text.clear();
  }
  if (absl::Status status = file->Append(text); !status.ok()) return status;
  return file->Commit();
}

absl::StatusOr<PatchTable> ReadPatchTable(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    return MakeError(absl::StatusCode::kNotFound,
                     {"TABLE_INVALID", path, "cannot be read or is empty",
                      "give a patches.csv as 'lambert bake' writes it"});
  }
  const std::vector<std::string> names = ColumnNames();
  std::vector<std::string_view> fields;
  SplitLine(line, fields);
  const absl::StatusOr<std::vector<size_t>> places = FindColumns(path, names, fields);
  if (!places.ok()) return places.status();
  PatchTable table;
  std::vector<double> values(names.size());
  for (int64_t number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    SplitLine(line, fields);
    for (size_t column = 0; column < names.size(); ++column) {
      const size_t place = (*places)[column];
      if (place >= fields.size() || !ParseField(fields[place], column < 5, values[column])) {
        return TableError(path, number, "no number in column '" + names[column] + "'");
      }
    }
    AddRow(values, table);
  }
  return table;
}

}  // namespace lambert
