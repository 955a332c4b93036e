// What is asked of a final gather and what comes of it, as data: no tracer, so that a client needs
// none.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"

namespace lambert {

// Where light is looked for, and on which side. Points on a patch are lifted off it; one within a
// solid sees its inside, which is black.
struct GatherPoints {
  std::vector<Vec3> position_m;  // relative to PatchSet::origin
  std::vector<Vec3> normal;      // unit; as many

  bool operator==(const GatherPoints&) const = default;
  size_t size() const { return position_m.size(); }
  void Add(Vec3 position, Vec3 unit_normal) {
    position_m.push_back(position);
    normal.push_back(unit_normal);
  }
};

// What arrives there, one value a point.
struct Gathered {
  std::vector<Rgb> irradiance_lx;
  std::vector<Rgb> std_error_lx;  // from kGatherReplicates independent parts; of the rays alone

  bool operator==(const Gathered&) const = default;
};

// Gathers somewhere: in this thread, or on a server's workers.
using GatherFunction = std::function<absl::StatusOr<Gathered>(const GatherPoints&)>;

inline constexpr int kGatherReplicates = 4;
inline constexpr int kMaxGatherRays = 1 << 16;
inline constexpr size_t kMaxGatherPoints = 1 << 20;  // of one task

struct GatherOptions {
  // Rays over the hemisphere of each point, and as many to lamps; rounded up to a multiple of
  // kGatherReplicates. 1 .. kMaxGatherRays.
  int rays_per_point = 64;
  uint64_t seed = 1;

  bool operator==(const GatherOptions&) const = default;
};

// What workers gather from, in one blob: everything but the patch set.
struct GatherTask {
  GatherOptions options;
  uint32_t first_name = 0;  // of point 0: points of one question may be gathered in parts
  std::vector<Rgb> radiosity_lm_per_m2;  // by patch
  GatherPoints points;

  bool operator==(const GatherTask&) const = default;
};

// A value >= 0 as it travels: what is below 0 is 0, what is beyond float32 its largest number.
float TravellingFloat(double value);

// Canonical bytes (docs/formats.md, "gather"). Decoding fails with DATA_LOSS and never crashes;
// values of a decoded one are finite, numbers of rays and points in range. Gathered values travel
// as float32.
std::string EncodeGatherPoints(const GatherPoints& points);
absl::StatusOr<GatherPoints> DecodeGatherPoints(const std::string& bytes);
std::string EncodeGatherTask(const GatherTask& task);
absl::StatusOr<GatherTask> DecodeGatherTask(const std::string& bytes);
std::string EncodeGathered(const Gathered& gathered);
absl::StatusOr<Gathered> DecodeGathered(const std::string& bytes);

}  // namespace lambert
