// Which directions rays take, which weight they carry: the options of the shooting methods.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/shoot/parts.h"
#include "radiosity/shoot/ray_numbers.h"

namespace lambert {

enum class Method : uint8_t {
  kAuto = 0,         // the planner's choice; resolved before anything is shot
  kPmcr = 1,         // progressive Monte Carlo radiosity: cosine-distributed rays (FP93)
  kPhs = 2,          // pyramidal hemisphere subdivision (JPS00)
  kMcr = 3,          // conventional Monte Carlo radiosity: passes of equal size (Shi91)
  kHs97 = 4,         // hemisphere subdivision by rays that carry energy (JP97)
  kHs98 = 5,         // hemisphere subdivision in two phases: probe, then distribute (JP98)
  kPhsAlpha = 6,     // phs that counts the patches that were hit (JPS00, 3.3)
  kPhsAdaptive = 7,  // phs whose pyramids are split where many patches are (JPS00, 6)
  kPhsHier = 8,      // phs whose light arrives at elements of a hierarchy (BNN98)
  kImportance = 9,   // directional importance of a region (NNB96)
  kExact = 10,       // closed-form form factors and a linear system (docs/exact.md)
  kWalk = 11,        // random walks: light goes on from the points that it hits (PM92)
};

// "auto", "pmcr", "phs", ... Parsing fails with FIELD_INVALID naming the choices.
const char* MethodName(Method method);
absl::StatusOr<Method> ParseMethod(const std::string& name);
// All but auto, in the order in which they are told about.
std::vector<Method> AllMethods();
// True where rays are divided over parts of the hemisphere: all but auto, mcr, pmcr, walk and
// exact.
bool UsesPyramids(Method method);

// How a ray's direction is drawn inside its pyramid.
enum class PyramidSampling : uint8_t {
  kSolidAngle = 0,      // uniform on the spherical triangle (Arvo 95), weight cos theta: the paper
  kProjectedAngle = 1,  // density ~ cos theta: every ray of a pyramid carries the same flux
};

// The parts of the hemisphere.
enum class CellShape : uint8_t {
  kTriangle = 0,  // spherical triangles: the paper
  kSquare = 1,    // squares of the concentric map: equal projected solid angles
};

// g in the density hf = (alpha1 f_p + alpha2 g) / (alpha1 + alpha2).
enum class DensityRule : uint8_t {
  kCount = 0,  // g = n_p / sum n: the paper
  kVariance =
      1,  // g ~ f_p sqrt(S_p): least variance of the error measure `metric` (docs/methods.md)
};

// How an emitter's expected rays follow from its flux.
enum class Allocation : uint8_t {
  kFlux = 0,      // r_i ~ Phi_i: all rays carry about the same
  kVariance = 1,  // r_i ~ Phi_i sum_p f_p sqrt(S_p)
};

struct PyramidOptions {
  CellShape cells = CellShape::kTriangle;
  int initial = 4;  // spherical triangles around the pole, >= 3 and <= 64
  int split = 4;    // children of a split: 4 (edge midpoints) or 3 (centroid)
  int depth = 2;    // splits, 0..4; 4 * 4^2 = 64 pyramids by default
  int grid = 8;     // squares along one side of the hemisphere, 1..64; 8 * 8 = 64
  int leaves = 64;  // phs-adaptive: pyramids of a patch at most, >= `initial`
  DensityRule rule = DensityRule::kCount;
  double metric = 0;  // of the variance rule: 0 unweighted RMS over patches .. 1 area-weighted
  double alpha1 = 1;  // weight of f_p, >= 0
  double alpha2 = 1;  // weight of g, >= 0; the sum of both > 0
  PyramidSampling sampling = PyramidSampling::kProjectedAngle;
  bool count_unseen = false;  // phs-alpha: patches that were not hit yet are estimated (Cha84)
  int probes = 4;             // hs97, hs98: probing rays for each pyramid, >= 1
  // phs-hier: rays of a step from one element to another, at most (refinement.h).
  double hier_flux = 0.05;  // >= 0; 0: every ray arrives at its patch
  double hier_size = 0.3;   // greatest radius of an element over the length of a ray to it, >= 0
  bool hier_densities = false;  // patches of few rays share the densities of an element
  // Rays in one visit from which a patch's densities are computed; fewer: cosine rays.
  // 0: chosen so that densities stay under a tenth of the run's time (docs/methods.md).
  int64_t min_rays = 0;

  // Parts that the hemisphere has.
  int CellCount() const;
  bool operator==(const PyramidOptions&) const = default;
};

// Of `exact`, whose memory and time grow with their square: 5,000 take about half a gigabyte.
inline constexpr int64_t kMaxExactPatches = 5000;

struct ShootOptions {
  Method method = Method::kPmcr;
  PyramidOptions pyramids;
  Sequence sequence = Sequence::kRandom;
  Allocation allocation = Allocation::kFlux;
  Parts parts;
  std::vector<std::string> region;  // importance: nodes by name or glTF index
  bool operator==(const ShootOptions&) const = default;
  absl::Status Validate() const;  // FIELD_INVALID naming the field that is out of range
  // The same for a scene of so many patches: FIELD_INVALID where they are too many for the method.
  absl::Status ValidateFor(int64_t patches) const;
};

}  // namespace lambert
