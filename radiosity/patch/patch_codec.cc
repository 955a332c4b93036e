// The canonical bytes of a patch set: docs/formats.md, "patch set".
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");
static_assert(sizeof(Vec3) == 24 && sizeof(Rgb) == 24 && sizeof(PatchSource) == 16 &&
              sizeof(std::array<Vec3, 3>) == 72 && sizeof(Transform) == 96);

constexpr char kMagic[8] = {'L', 'M', 'B', 'P', 'T', 'C', 'H', '3'};

class Writer {
 public:
  template <typename T>
  void Value(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename T>
  void Column(const std::vector<T>& column) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(T));
  }
  void Text(const std::string& text) {
    Value<uint64_t>(text.size());
    bytes_ += text;
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads what Writer wrote. After the first failure every read fails and gives zeros.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <typename T>
  T Value() {
    T value{};
    if (Has(1, sizeof value)) std::memcpy(&value, Advance(sizeof value), sizeof value);
    return value;
  }
  template <typename T>
  void Column(uint64_t count, std::vector<T>* column) {
    if (!Has(count, sizeof(T))) return;
    column->resize(count);
    if (count > 0) std::memcpy(column->data(), Advance(count * sizeof(T)), count * sizeof(T));
  }
  std::string Text() {
    const uint64_t size = Value<uint64_t>();
    return Has(size, 1) ? std::string(Advance(size), size) : std::string();
  }
  // A count of items of at least `least_size` bytes each that still can follow; else 0 and failure.
  uint64_t Count(uint64_t least_size) {
    const uint64_t count = Value<uint64_t>();
    return Has(count, least_size) ? count : 0;
  }
  // One byte, 0 or 1; else failure.
  bool Flag() {
    const uint8_t flag = Value<uint8_t>();
    ok_ = ok_ && flag <= 1;
    return flag == 1;
  }
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && position_ == bytes_.size(); }

 private:
  bool Has(uint64_t count, uint64_t size) {
    ok_ = ok_ && count <= (bytes_.size() - position_) / size;
    return ok_;
  }
  const char* Advance(uint64_t size) {
    const char* here = bytes_.data() + position_;
    position_ += size;
    return here;
  }

  const std::string& bytes_;
  uint64_t position_ = 0;
  bool ok_ = true;
};

void WriteCamera(const Camera& camera, Writer* writer) {
  writer->Text(camera.name);
  writer->Value(camera.world);
  writer->Value<uint8_t>(camera.perspective);
  for (double x : {camera.yfov_rad, camera.half_height_m, camera.aspect}) writer->Value(x);
}

Camera ReadCamera(Reader* reader) {
  Camera camera;
  camera.name = reader->Text();
  camera.world = reader->Value<Transform>();
  camera.perspective = reader->Flag();
  for (double* x : {&camera.yfov_rad, &camera.half_height_m, &camera.aspect}) {
    *x = reader->Value<double>();
  }
  return camera;
}

// The tables of lights, each once, in the order of the lights.
using Tables = std::vector<std::shared_ptr<const SphereTable>>;

Tables TablesOf(const std::vector<Light>& lights) {
  Tables tables;
  std::set<const SphereTable*> known;
  for (const Light& light : lights) {
    if (HasTable(light) && known.insert(light.table.get()).second) tables.push_back(light.table);
  }
  return tables;
}

void WriteTable(const SphereTable& table, Writer* writer) {
  const SphereGrid& grid = table.grid();
  writer->Value<uint8_t>(grid.linear);
  writer->Value<uint8_t>(grid.channels);
  writer->Value<uint64_t>(grid.z.size());
  writer->Value<uint64_t>(grid.turn.size());
  writer->Value<uint64_t>(grid.values.size());
  writer->Column(grid.z);
  writer->Column(grid.turn);
  writer->Column(grid.values);
}

void WriteLight(const Light& light, const std::map<const SphereTable*, uint64_t>& places,
                Writer* writer) {
  writer->Text(light.name);
  writer->Value(light.kind);
  writer->Value(light.position);
  writer->Value(light.strength);
  for (const Vec3& axis : {light.x, light.y, light.z}) writer->Value(axis);
  for (double cosine : {light.cos_inner, light.cos_outer}) writer->Value(cosine);
  if (HasTable(light)) writer->Value(places.at(light.table.get()));
}

void WriteLights(const std::vector<Light>& lights, Writer* writer) {
  const Tables tables = TablesOf(lights);
  writer->Value<uint64_t>(tables.size());
  std::map<const SphereTable*, uint64_t> places;
  for (const auto& table : tables) {
    WriteTable(*table, writer);
    places.emplace(table.get(), places.size());
  }
  writer->Value<uint64_t>(lights.size());
  for (const Light& light : lights) WriteLight(light, places, writer);
}

std::shared_ptr<const SphereTable> ReadTable(Reader* reader) {
  SphereGrid grid;
  grid.linear = reader->Flag();
  grid.channels = reader->Value<uint8_t>();
  const uint64_t z = reader->Count(sizeof(double)), turn = reader->Count(sizeof(double)),
                 values = reader->Count(sizeof(float));
  reader->Column(z, &grid.z);
  reader->Column(turn, &grid.turn);
  reader->Column(values, &grid.values);
  return reader->ok() ? SphereTable::Create(std::move(grid)).value_or(nullptr) : nullptr;
}

Light ReadLight(const Tables& tables, Reader* reader) {
  Light light;
  light.name = reader->Text();
  light.kind = reader->Value<Light::Kind>();
  light.position = reader->Value<Vec3>();
  light.strength = reader->Value<Rgb>();
  for (Vec3* axis : {&light.x, &light.y, &light.z}) *axis = reader->Value<Vec3>();
  for (double* cosine : {&light.cos_inner, &light.cos_outer}) *cosine = reader->Value<double>();
  if (!HasTable(light)) return light;
  const uint64_t table = reader->Value<uint64_t>();
  if (table < tables.size()) light.table = tables[table];
  return light;
}

// False for tables that are not those of the lights, in their order.
bool ReadLights(Reader* reader, std::vector<Light>* lights) {
  Tables tables;
  const uint64_t table_count = reader->Count(2 + 3 * sizeof(uint64_t));
  for (uint64_t i = 0; i < table_count && reader->ok(); ++i) {
    tables.push_back(ReadTable(reader));
    if (tables.back() == nullptr) return false;
  }
  const uint64_t count = reader->Count(sizeof(uint64_t) + sizeof(Vec3) + sizeof(Rgb));
  for (uint64_t i = 0; i < count && reader->ok(); ++i) {
    lights->push_back(ReadLight(tables, reader));
    if (HasTable(lights->back()) && lights->back().table == nullptr) return false;
  }
  return TablesOf(*lights) == tables;
}

void ReadAnnotations(Reader* reader, PatchSet* patches) {
  const uint64_t names = reader->Count(sizeof(uint64_t));
  for (uint64_t i = 0; i < names && reader->ok(); ++i) {
    patches->node_names.push_back(reader->Text());
  }
  const uint64_t cameras = reader->Count(sizeof(Transform));
  for (uint64_t i = 0; i < cameras && reader->ok(); ++i) {
    patches->cameras.push_back(ReadCamera(reader));
  }
  const uint64_t warnings = reader->Count(2 * sizeof(uint64_t));
  for (uint64_t i = 0; i < warnings && reader->ok(); ++i) {
    std::string reason = reader->Text();
    patches->warnings.push_back({std::move(reason), reader->Text()});
  }
}

bool IsFraction(Rgb a) {
  return a.r >= 0 && a.r <= 1 && a.g >= 0 && a.g <= 1 && a.b >= 0 && a.b <= 1;
}

bool IsFluxLike(Rgb a) { return IsFinite(a) && a.r >= 0 && a.g >= 0 && a.b >= 0; }

bool IsUnit(const Vec3& axis) { return std::fabs(Dot(axis, axis) - 1) < 1e-6; }

const char* FindFault(const Light& light) {
  if (light.kind > Light::Kind::kSky) return "a light is of no known kind";
  if (!IsFinite(light.position) || !IsFluxLike(light.strength)) {
    return "a light is not finite or is negative";
  }
  if (!IsUnit(light.x) || !IsUnit(light.y) || !IsUnit(light.z)) {
    return "an axis of a light is not of length 1";
  }
  if (!(light.cos_outer >= -1) || !(light.cos_outer <= 1) ||
      !(light.cos_inner >= light.cos_outer) || !std::isfinite(light.cos_inner)) {
    return "a cone of a light cannot be";
  }
  return nullptr;
}

bool IsUsable(const Camera& camera) {
  const Transform& world = camera.world;
  return IsFinite(world.x) && IsFinite(world.y) && IsFinite(world.z) &&
         IsFinite(world.translation) && std::isfinite(camera.yfov_rad) &&
         std::isfinite(camera.half_height_m) && std::isfinite(camera.aspect);
}

// A back stands right after its front, and each names the other.
bool TwinIsRight(const PatchSet& patches, PatchIndex i) {
  const bool back = patches.is_back[i] != 0;
  const PatchIndex twin = patches.twin[i];
  if (twin == kNoPatch) return !back;
  if (patches.is_back[i] > 1 || twin != (back ? i - 1 : i + 1)) return false;
  return twin >= 0 && twin < patches.size() && patches.twin[twin] == i &&
         patches.is_back[twin] == !back;
}

const char* FindFault(const PatchSet& patches) {
  if (!IsFinite(patches.origin)) return "the origin is not finite";
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const auto& [a, b, c] = patches.corners[i];
    const PatchSource& source = patches.source[i];
    if (!IsFinite(a) || !IsFinite(b) || !IsFinite(c)) return "a corner is not finite";
    if (!(patches.area_m2[i] > 0) || !std::isfinite(patches.area_m2[i])) {
      return "an area is not over 0";
    }
    if (!IsFraction(patches.reflectance[i])) return "a reflectance is not in 0..1";
    if (!IsFluxLike(patches.exitance_lm_per_m2[i])) return "an exitance is negative or not finite";
    if (!TwinIsRight(patches, i)) return "a twin is not the other side of its patch";
    if (std::min({source.node, source.mesh, source.primitive, source.triangle}) < 0) {
      return "a source index is negative";
    }
  }
  for (const Light& light : patches.lights) {
    if (const char* fault = FindFault(light)) return fault;
  }
  for (const Camera& camera : patches.cameras) {
    if (!IsUsable(camera)) return "a camera is not finite";
  }
  return nullptr;
}

absl::Status DataLoss(const std::string& message) {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"PATCH_SET_INVALID", "patch set", message, "fetch or build it again"});
}

}  // namespace

std::string EncodePatchSet(const PatchSet& patches) {
  Writer writer;
  writer.Value(kMagic);
  writer.Value<uint64_t>(patches.corners.size());
  writer.Value(patches.origin);
  writer.Column(patches.corners);
  writer.Column(patches.area_m2);
  writer.Column(patches.reflectance);
  writer.Column(patches.exitance_lm_per_m2);
  writer.Column(patches.twin);
  writer.Column(patches.is_back);
  writer.Column(patches.source);
  WriteLights(patches.lights, &writer);
  writer.Value<uint64_t>(patches.node_names.size());
  for (const std::string& name : patches.node_names) writer.Text(name);
  writer.Value<uint64_t>(patches.cameras.size());
  for (const Camera& camera : patches.cameras) WriteCamera(camera, &writer);
  writer.Value<uint64_t>(patches.warnings.size());
  for (const Warning& warning : patches.warnings) {
    writer.Text(warning.reason);
    writer.Text(warning.message);
  }
  return writer.Take();
}

absl::StatusOr<PatchSet> DecodePatchSet(const std::string& bytes) {
  Reader reader(bytes);
  if (bytes.compare(0, sizeof kMagic, kMagic, sizeof kMagic) != 0) {
    return DataLoss("it does not begin with LMBPTCH3");
  }
  reader.Value<uint64_t>();
  PatchSet patches;
  const uint64_t count = reader.Count(sizeof(std::array<Vec3, 3>));
  if (count > static_cast<uint64_t>(std::numeric_limits<PatchIndex>::max())) {
    return DataLoss("it holds more patches than can be counted");
  }
  patches.origin = reader.Value<Vec3>();
  reader.Column(count, &patches.corners);
  reader.Column(count, &patches.area_m2);
  reader.Column(count, &patches.reflectance);
  reader.Column(count, &patches.exitance_lm_per_m2);
  reader.Column(count, &patches.twin);
  reader.Column(count, &patches.is_back);
  reader.Column(count, &patches.source);
  if (!ReadLights(&reader, &patches.lights)) return DataLoss("a table of a light cannot be");
  ReadAnnotations(&reader, &patches);
  if (!reader.at_end()) return DataLoss("its length is not what its counts say");
  if (const char* fault = FindFault(patches)) return DataLoss(fault);
  return patches;
}

}  // namespace lambert
