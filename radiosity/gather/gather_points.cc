#include "radiosity/gather/gather_points.h"

#include <algorithm>
#include <limits>

#include "radiosity/core/bytes.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kPointsMagic = 0x3150474C;    // "LGP1"
constexpr uint32_t kTaskMagic = 0x3154474C;      // "LGT1"
constexpr uint32_t kGatheredMagic = 0x3156474C;  // "LGV1"

struct CountHeader {
  uint32_t magic = 0, count = 0;
};

struct TaskHeader {
  uint32_t magic = kTaskMagic;
  int32_t rays_per_point = 0;
  uint64_t seed = 0;
  uint32_t first_name = 0, patches = 0;
};
static_assert(sizeof(TaskHeader) == 24);

constexpr size_t kPointBytes = 2 * sizeof(Vec3);
constexpr size_t kGatheredBytes = 6 * sizeof(float);

absl::Status Corrupt(const std::string& what) {
  return MakeError(absl::StatusCode::kDataLoss, {"GATHER_INVALID", what, "the bytes are no " + what,
                                                 "use programs of one version"});
}

void PutPoints(const GatherPoints& points, ByteWriter& writer) {
  writer.Put(CountHeader{kPointsMagic, static_cast<uint32_t>(points.size())});
  writer.PutArray(points.position_m.data(), points.size());
  writer.PutArray(points.normal.data(), points.size());
}

// The rest of the bytes.
absl::StatusOr<GatherPoints> ReadPoints(ByteReader& reader) {
  CountHeader header;
  if (!reader.Get(&header) || header.magic != kPointsMagic || header.count > kMaxGatherPoints ||
      reader.remaining() != header.count * kPointBytes) {
    return Corrupt("points");
  }
  GatherPoints points;
  points.position_m.resize(header.count);
  points.normal.resize(header.count);
  reader.GetArray(points.position_m.data(), header.count);
  reader.GetArray(points.normal.data(), header.count);
  for (const std::vector<Vec3>* vectors : {&points.position_m, &points.normal}) {
    if (!std::all_of(vectors->begin(), vectors->end(), [](Vec3 v) { return IsFinite(v); })) {
      return Corrupt("points");
    }
  }
  return points;
}

std::array<float, 3> InFloats(Rgb value) {
  std::array<float, 3> floats;
  for (int c = 0; c < 3; ++c) floats[c] = TravellingFloat(value[c]);
  return floats;
}

}  // namespace

float TravellingFloat(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(value > 0 ? std::min(value, kLargest) : 0.0);
}

std::string EncodeGatherPoints(const GatherPoints& points) {
  ByteWriter writer;
  PutPoints(points, writer);
  return writer.Take();
}

absl::StatusOr<GatherPoints> DecodeGatherPoints(const std::string& bytes) {
  ByteReader reader(bytes);
  return ReadPoints(reader);
}

std::string EncodeGatherTask(const GatherTask& task) {
  ByteWriter writer;
  const size_t patches = task.radiosity_lm_per_m2.size();
  writer.Put(TaskHeader{kTaskMagic, task.options.rays_per_point, task.options.seed, task.first_name,
                        static_cast<uint32_t>(patches)});
  writer.PutArray(task.radiosity_lm_per_m2.data(), patches);
  PutPoints(task.points, writer);
  return writer.Take();
}

absl::StatusOr<GatherTask> DecodeGatherTask(const std::string& bytes) {
  ByteReader reader(bytes);
  TaskHeader header;
  if (!reader.Get(&header) || header.magic != kTaskMagic || header.rays_per_point < 1 ||
      header.rays_per_point > kMaxGatherRays || header.patches > reader.remaining() / sizeof(Rgb)) {
    return Corrupt("gather task");
  }
  GatherTask task;
  task.options = {header.rays_per_point, header.seed};
  task.first_name = header.first_name;
  task.radiosity_lm_per_m2.resize(header.patches);
  reader.GetArray(task.radiosity_lm_per_m2.data(), header.patches);
  const auto is_finite = [](Rgb value) { return IsFinite(value); };
  if (!std::all_of(task.radiosity_lm_per_m2.begin(), task.radiosity_lm_per_m2.end(), is_finite)) {
    return Corrupt("gather task");
  }
  absl::StatusOr<GatherPoints> points = ReadPoints(reader);
  if (!points.ok()) return points.status();
  task.points = *std::move(points);
  return task;
}

std::string EncodeGathered(const Gathered& gathered) {
  ByteWriter writer;
  writer.Put(CountHeader{kGatheredMagic, static_cast<uint32_t>(gathered.irradiance_lx.size())});
  for (size_t i = 0; i < gathered.irradiance_lx.size(); ++i) {
    writer.Put(InFloats(gathered.irradiance_lx[i]));
    writer.Put(InFloats(gathered.std_error_lx[i]));
  }
  return writer.Take();
}

absl::StatusOr<Gathered> DecodeGathered(const std::string& bytes) {
  ByteReader reader(bytes);
  CountHeader header;
  if (!reader.Get(&header) || header.magic != kGatheredMagic ||
      reader.remaining() != header.count * kGatheredBytes) {
    return Corrupt("gathered values");
  }
  Gathered gathered;
  for (uint32_t i = 0; i < header.count; ++i) {
    for (std::vector<Rgb>* values : {&gathered.irradiance_lx, &gathered.std_error_lx}) {
      std::array<float, 3> floats;
      reader.GetArray(floats.data(), floats.size());
      values->push_back({floats[0], floats[1], floats[2]});
      if (!IsFinite(values->back())) return Corrupt("gathered values");
    }
  }
  return gathered;
}

}  // namespace lambert
