#include "radiosity/patch/patch_warnings.h"

#include "absl/strings/str_cat.h"

namespace lambert {
namespace {

constexpr double kHighReflectance = 0.95;  // white paint reflects .85, fresh snow .9

// Area vectors of a closed surface sum to zero, up to the float32 digits of the file.
constexpr double kClosedTolerance = 1e-5;

int64_t CountHighReflectance(const PatchSet& patches) {
  int64_t count = 0;
  for (const Rgb& rho : patches.reflectance) {
    if (std::max({rho.r, rho.g, rho.b}) > kHighReflectance) ++count;
  }
  return count;
}

// Divergence theorem: six times the volume inside a closed surface is the sum of a . (b x c) over
// its triangles; positive where they face outward. A room, whose walls face inward, has a negative
// volume however much furniture stands in it.
bool IsClosedAndFacesOutward(const PatchSet& patches) {
  Vec3 area_vector_m2;
  double area_m2 = 0, volume_m3 = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.twin[i] != kNoPatch) continue;
    const auto& [a, b, c] = patches.corners[i];
    area_vector_m2 = area_vector_m2 + Cross(b - a, c - a) / 2;
    area_m2 += patches.area_m2[i];
    volume_m3 += Dot(a, Cross(b, c)) / 6;
  }
  return area_m2 > 0 && Length(area_vector_m2) < kClosedTolerance * area_m2 &&
         volume_m3 > kClosedTolerance * area_m2 * std::sqrt(area_m2);
}

}  // namespace

void AppendPatchWarnings(PatchSet* patches) {
  if (EmittedFlux(*patches) == Rgb{}) {
    patches->warnings.push_back(
        {"NO_EMITTERS", "nothing in the scene emits light: the solution is zero everywhere"});
  }
  if (const int64_t count = CountHighReflectance(*patches); count > 0) {
    patches->warnings.push_back(
        {"REFLECTANCE_HIGH", absl::StrCat(count,
                                          " patch(es) reflect more than 95 %, more than any "
                                          "paint: light will bounce for long")});
  }
  if (IsClosedAndFacesOutward(*patches)) {
    patches->warnings.push_back(
        {"POSSIBLY_INVERTED_NORMALS",
         "the surface of the scene is closed and faces outward; if it is a room, turn its winding "
         "round or pass --two-sided"});
  }
}

}  // namespace lambert
