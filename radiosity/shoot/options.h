// Which directions rays take, which weight they carry: the options of the shooting methods.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace lambert {

enum class Method : uint8_t {
  kAuto = 0,  // the planner's choice; resolved before anything is shot
  kPmcr = 1,  // progressive Monte Carlo radiosity: cosine-distributed rays (FP93)
  kPhs = 2,   // pyramidal hemisphere subdivision (JPS00)
};

// "auto", "pmcr", "phs". Parsing fails with FIELD_INVALID naming the choices.
const char* MethodName(Method method);
absl::StatusOr<Method> ParseMethod(const std::string& name);
// Every method that shoots: all but kAuto, in the order of their numbers.
std::vector<Method> AllMethods();

// How a ray's direction is drawn inside its pyramid.
enum class PyramidSampling : uint8_t {
  kSolidAngle = 0,      // uniform on the spherical triangle (Arvo 95), weight cos theta: the paper
  kProjectedAngle = 1,  // density ~ cos theta: every ray of a pyramid carries the same flux
};

struct PyramidOptions {
  int initial = 4;    // spherical triangles around the pole, >= 3 and <= 64
  int split = 4;      // children of a split: 4 (edge midpoints) or 3 (centroid)
  int depth = 2;      // splits, 0..4; 4 * 4^2 = 64 pyramids by default
  double alpha1 = 1;  // weight of f_p, >= 0
  double alpha2 = 1;  // weight of g(n_ip), >= 0; the sum of both > 0
  PyramidSampling sampling = PyramidSampling::kProjectedAngle;
  bool count_black = false;  // true: patches of null reflectance count in n_ip too
  bool use_clusters = true;  // false: test every vertex; the counts are the same
  // Rays in one visit from which a patch's densities are computed; fewer: cosine rays.
  // 0: chosen so that densities stay under a tenth of the run's time (docs/methods.md).
  int64_t min_rays = 0;
};

struct ShootOptions {
  Method method = Method::kPmcr;
  PyramidOptions pyramids;
  absl::Status Validate() const;  // FIELD_INVALID naming the field that is out of range
};

}  // namespace lambert
