#include "radiosity/output/sensors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "radiosity/output/exposure.h"
#include "radiosity/output/number_text.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// Looks around itself: from inside a solid most rays meet a back.
constexpr int kLooks = 14;

// Directions to the faces and the corners of a cube.
std::array<Vec3, kLooks> LooksAround() {
  std::array<Vec3, kLooks> looks;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (double sign : {-1.0, 1.0}) {
      looks[count++] = {axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    }
  }
  for (int corner = 0; corner < 8; ++corner) {
    looks[count++] = {corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0, corner & 4 ? 1.0 : -1.0};
  }
  return looks;
}

// Whether more than half of what a point (relative to the patch set's origin) sees are backs.
bool IsInside(const RayScene& scene, Vec3 point) {
  const Vec3 origin = scene.ToTrace(point);
  const double past = Length(origin) + 2;  // the scene's diagonal is less than 2
  auto nearest = std::make_unique<RayBatch>(), any = std::make_unique<RayBatch>();
  for (const Vec3& look : LooksAround()) {
    // Off the axes, on which edges of models lie.
    const Vec3 way = Normalized(look + Vec3{0.013, 0.017, 0.011});
    nearest->Add(origin, way);
    any->Add(origin, way * past);
  }
  scene.Trace(*nearest);
  scene.Occlude(*any);
  int backs = 0;
  for (int k = 0; k < kLooks; ++k) {
    backs += nearest->hit[k] == kEscaped && any->hit[k] == kBlocked;
  }
  return 2 * backs > kLooks;
}

void AppendFields(const Vec3& v, std::string& text) {
  for (double number : {v.x, v.y, v.z}) {
    text.push_back(',');
    AppendNumber(number, text);
  }
}
void AppendFields(const Rgb& v, std::string& text) { AppendFields(Vec3{v.r, v.g, v.b}, text); }

}  // namespace

GridFigures FiguresOf(const SensorGrid& grid) {
  GridFigures figures;
  double sum = 0;
  figures.min_lx = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < grid.position_m.size(); ++i) {
    ++figures.sensors;
    if (grid.is_inside[i]) {
      ++figures.inside;
      continue;
    }
    const double lx = Luminance(grid.irradiance_lx[i]);
    sum += lx;
    figures.min_lx = std::min(figures.min_lx, lx);
    figures.max_lx = std::max(figures.max_lx, lx);
  }
  if (figures.sensors == figures.inside) return {figures.sensors, figures.inside};
  figures.mean_lx = sum / static_cast<double>(figures.sensors - figures.inside);
  figures.uniformity = figures.mean_lx > 0 ? figures.min_lx / figures.mean_lx : 0;
  return figures;
}

double GridSpacing(double side_m, double other_side_m) {
  const double shorter = std::min(side_m, other_side_m), longer = std::max(side_m, other_side_m);
  const double d = longer >= 2 * shorter ? shorter : longer;
  return std::min(0.2 * std::pow(5, std::log10(d)), 10.0);
}

int PointsAlong(double side_m, double spacing_m) {
  constexpr double kRounding = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(side_m / spacing_m - kRounding)));
}

absl::Status GatherSensors(const PatchSet& patches, const GatherFunction& gather,
                           std::vector<SensorGrid>& grids) {
  const auto scene = RayScene::Create(patches);
  if (!scene.ok()) return scene.status();
  GatherPoints points;
  for (SensorGrid& grid : grids) {
    grid.is_inside.clear();
    for (size_t i = 0; i < grid.position_m.size(); ++i) {
      const Vec3 at = grid.position_m[i] - patches.origin;
      points.Add(at, grid.normal[i]);
      grid.is_inside.push_back(IsInside(**scene, at));
    }
  }
  const absl::StatusOr<Gathered> gathered = gather(points);
  if (!gathered.ok()) return gathered.status();
  size_t begin = 0;
  for (SensorGrid& grid : grids) {
    const auto from = static_cast<ptrdiff_t>(begin);
    const auto to = static_cast<ptrdiff_t>(begin += grid.position_m.size());
    const auto cut = [&](const std::vector<Rgb>& of) {
      return std::vector<Rgb>(of.begin() + from, of.begin() + to);
    };
    grid.irradiance_lx = cut(gathered->irradiance_lx);
    grid.std_error_lx = cut(gathered->std_error_lx);
  }
  return absl::OkStatus();
}

std::string EncodeSensorsCsv(const std::vector<SensorGrid>& grids) {
  std::string text =
      "grid,sensor,x,y,z,nx,ny,nz,inside,illuminance,irradiance_r,irradiance_g,irradiance_b,"
      "std_error_r,std_error_g,std_error_b\n";
  for (const SensorGrid& grid : grids) {
    std::string name = grid.name;
    std::erase_if(name, [](char c) { return c == ',' || c == '"' || c == '\n' || c == '\r'; });
    for (size_t i = 0; i < grid.position_m.size(); ++i) {
      text += name + ",";
      AppendNumber(i, text);
      AppendFields(grid.position_m[i], text);
      AppendFields(grid.normal[i], text);
      text += grid.is_inside[i] ? ",1," : ",0,";
      AppendNumber(Luminance(grid.irradiance_lx[i]), text);
      AppendFields(grid.irradiance_lx[i], text);
      AppendFields(grid.std_error_lx[i], text);
      text.push_back('\n');
    }
  }
  return text;
}

std::string EncodeSensorsJson(const std::vector<SensorGrid>& grids) {
  nlohmann::ordered_json json;
  json["rays_per_sensor"] = kSensorRays;
  json["grids"] = nlohmann::ordered_json::array();
  for (const SensorGrid& grid : grids) {
    const GridFigures figures = FiguresOf(grid);
    nlohmann::ordered_json lux = nlohmann::ordered_json::array();
    for (const Rgb& irradiance : grid.irradiance_lx) lux.push_back(Luminance(irradiance));
    json["grids"].push_back({{"name", grid.name},
                             {"sensors", figures.sensors},
                             {"inside", figures.inside},
                             {"mean", figures.mean_lx},
                             {"minimum", figures.min_lx},
                             {"maximum", figures.max_lx},
                             {"uniformity_u0", figures.uniformity},
                             {"illuminance", lux}});
  }
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace lambert
