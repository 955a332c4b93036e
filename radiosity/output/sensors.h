// Sensors: illuminance at free points, in grids, with the figures that lighting design asks for.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Rays over the hemisphere of each sensor, and as many to lamps.
inline constexpr int kSensorRays = 4096;

struct SensorGrid {
  std::string name;
  std::vector<Vec3> position_m;  // world
  std::vector<Vec3> normal;      // unit: where the sensor looks
  // Once they are gathered:
  std::vector<bool> is_inside;  // of a solid: told, and left out of the figures
  std::vector<Rgb> irradiance_lx, std_error_lx;
};

// Illuminance (luminance weights of the channels) of the sensors that stand free.
struct GridFigures {
  int64_t sensors = 0, inside = 0;
  double mean_lx = 0, min_lx = 0, max_lx = 0;
  double uniformity = 0;  // U0 = minimum / mean; 0 where nothing arrives
};
// Requires: a gathered grid.
GridFigures FiguresOf(const SensorGrid& grid);

// Most distance between the points of a grid (EN 12464-1):  p = 0.2 * 5^log10(d), at most 10 m
// d: the longer side of the area or, where that is twice the shorter one or more, the shorter [m].
double GridSpacing(double side_m, double other_side_m);
// Points along a side so that they are no further apart: > 0.
int PointsAlong(double side_m, double spacing_m);

// What --sensors names, as docs/formats.md says: a .json file of grids, or else a table of points.
// SENSORS_INVALID, naming `path` and place; FILE_NOT_FOUND.
absl::StatusOr<std::vector<SensorGrid>> ReadSensors(const std::string& path);

// A grid over the floor of each room, `height_m` above it, sensors up; the outer kWallZone_m are
// left out. Up is +y. A floor: upward patches that touch, of 2 m2 together or more, without another
// floor less than 1.8 m below. Its area is its bounding rectangle; sensors that have no floor below
// are left out. SENSORS_INVALID where there is no floor large enough.
inline constexpr double kWallZone_m = 0.5;
absl::StatusOr<std::vector<SensorGrid>> WorkPlanes(const PatchSet& patches, double height_m);

// Fills in `is_inside` and what `gather` finds. Fails as it does, and as RayScene::Create.
absl::Status GatherSensors(const PatchSet& patches, const GatherFunction& gather,
                           std::vector<SensorGrid>& grids);

// sensors.csv and sensors.json.
std::string EncodeSensorsCsv(const std::vector<SensorGrid>& grids);
std::string EncodeSensorsJson(const std::vector<SensorGrid>& grids);

}  // namespace lambert
