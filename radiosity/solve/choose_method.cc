#include "radiosity/solve/choose_method.h"

#include <cstdio>

namespace lambert {
namespace {

// Mean area times mean inverse area, 1 for equal patches. Over it, small patches stand among large
// ones and pyramids send them more rays; under it they only add noise (docs/methods.md).
constexpr double kUnevenAreas = 4;

double AreaUnevenness(const PatchSet& patches) {
  double sum = 0, inverse = 0;
  for (double area : patches.area_m2) {
    sum += area;
    inverse += 1 / area;
  }
  const double n = patches.size();
  return (sum / n) * (inverse / n);
}

}  // namespace

MethodChoice ChooseMethod(const PatchSet& patches, const SolveOptions& /*options*/) {
  const double unevenness = AreaUnevenness(patches);
  const bool uneven = unevenness > kUnevenAreas;
  char reason[200];
  std::snprintf(
      reason, sizeof(reason),
      uneven
          ? "patch areas are uneven (mean area times mean inverse area %.3g): small patches get "
            "more rays"
          : "patch areas are even (mean area times mean inverse area %.3g, under %.3g): densities "
            "would only add noise",
      unevenness, kUnevenAreas);
  return {uneven ? Method::kPhs : Method::kPmcr, reason};
}

}  // namespace lambert
