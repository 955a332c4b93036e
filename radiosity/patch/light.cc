#include "radiosity/patch/light.h"

#include <cmath>

namespace lambert {

int LightCount(const PatchSet& patches) { return static_cast<int>(patches.point_lights.size()); }

bool IsDelta(const PatchSet&, int) { return true; }

LightSample SampleLight(const PatchSet& patches, int light, const Vec3& point, double, double) {
  const PointLight& from = patches.point_lights[light];
  const Vec3 way = from.position - point;
  const double square_m2 = Dot(way, way);
  if (!(square_m2 > 0)) return {{0, 0, 1}, 0, {}};
  const double distance_m = std::sqrt(square_m2);
  return {way / distance_m, distance_m, from.intensity_cd / square_m2};
}

}  // namespace lambert
