#include "radiosity/patch/patch_warnings.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/patch/coplanar_overlap.h"
#include "radiosity/patch/patch_builder.h"

namespace lambert {
namespace {

constexpr double kHighReflectance = 0.95;  // white paint reflects .85, fresh snow .9

// Area vectors of a closed surface sum to zero, up to the float32 digits of the file.
constexpr double kClosedTolerance = 1e-5;

// Brighter than the sun six times over: a unit or an exponent is wrong, and what others emit drowns
// in its noise.
constexpr double kHighLuminanceNit = 1e10;

// A light this near to a patch lies on it; as a share of the scene's diagonal: the tracer's
// offsets are about as large.
constexpr double kOnSurface = 1e-6;

int64_t CountHighReflectance(const PatchSet& patches) {
  int64_t count = 0;
  for (const Rgb& rho : patches.reflectance) {
    if (std::max({rho.r, rho.g, rho.b}) > kHighReflectance) ++count;
  }
  return count;
}

int64_t CountHighEmission(const PatchSet& patches) {
  const auto is_high = [](const Rgb& exitance) {
    return std::max({exitance.r, exitance.g, exitance.b}) > kHighLuminanceNit * std::numbers::pi;
  };
  return std::count_if(patches.exitance_lm_per_m2.begin(), patches.exitance_lm_per_m2.end(),
                       is_high);
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

double DistanceToSegment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 ab = b - a;
  const double t = std::clamp(Dot(p - a, ab) / Dot(ab, ab), 0.0, 1.0);
  return Length(p - (a + ab * t));
}

double DistanceToTriangle(Vec3 p, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = Normalized(Cross(b - a, c - a));
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = corners[k], to = corners[(k + 1) % 3];
    inside = inside && Dot(Cross(to - from, p - from), normal) >= 0;
  }
  if (inside) return std::fabs(Dot(p - a, normal));
  return std::min(
      {DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a)});
}

// Whether each light that has a place lies on a patch. Only lights within a patch's extent in x are
// measured.
std::vector<bool> FindLightsOnSurfaces(const PatchSet& patches) {
  std::vector<bool> on_surface(patches.lights.size());
  std::vector<std::pair<double, size_t>> by_x;  // x, index of the light
  for (size_t l = 0; l < patches.lights.size(); ++l) {
    if (HasPlace(patches.lights[l])) by_x.emplace_back(patches.lights[l].position.x, l);
  }
  if (by_x.empty()) return on_surface;
  std::sort(by_x.begin(), by_x.end());
  const double near_m = kOnSurface * BoundsOf(patches).Diagonal();
  for (const auto& corners : patches.corners) {
    const auto [low, high] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    for (auto it = std::lower_bound(by_x.begin(), by_x.end(), std::pair(low - near_m, size_t{0}));
         it != by_x.end() && it->first <= high + near_m; ++it) {
      const Vec3 position = patches.lights[it->second].position;
      if (DistanceToTriangle(position, corners) <= near_m) on_surface[it->second] = true;
    }
  }
  return on_surface;
}

void AppendLightsOnSurfaces(PatchSet* patches) {
  const std::vector<bool> on_surface = FindLightsOnSurfaces(*patches);
  const auto first = std::find(on_surface.begin(), on_surface.end(), true);
  if (first == on_surface.end()) return;
  const size_t light = first - on_surface.begin();
  patches->warnings.push_back(
      {"LIGHT_ON_SURFACE",
       absl::StrCat(std::count(first, on_surface.end(), true),
                    " light(s) lie on a patch, the first is light ", light, " \"",
                    patches->lights[light].name,
                    "\": rounding decides which side it lights, and what it sends to the other "
                    "side is lost; move it off the surface")});
}

// "node 1, mesh 2, primitive 0, triangle 7 "rug"".
std::string Named(const PatchSet& patches, PatchIndex i) {
  const PatchSource& source = patches.source[i];
  return absl::StrCat(Where(source), " \"", patches.node_names[source.node], "\"");
}

void AppendCoplanarOverlaps(PatchSet* patches) {
  const CoplanarOverlaps found = FindCoplanarOverlaps(*patches);
  if (found.patches == 0) return;
  patches->warnings.push_back(
      {"COPLANAR_OVERLAP",
       absl::StrCat(found.patches, " patch(es) lie on one another in one plane, the first are ",
                    Named(*patches, found.first), " and ", Named(*patches, found.other),
                    ": which of them light meets is left to chance; move one off the plane, or "
                    "delete what is hidden")});
}

}  // namespace

void AppendPatchWarnings(PatchSet* patches) {
  if (EmittedFlux(*patches) == Rgb{}) {
    patches->warnings.push_back(
        {"NO_EMITTERS", "nothing in the scene emits light: the solution is zero everywhere"});
  }
  if (const int64_t count = CountHighEmission(*patches); count > 0) {
    patches->warnings.push_back(
        {"EMISSION_HIGH", absl::StrCat(count,
                                       " patch(es) are brighter than 1e10 nit, more than the sun: "
                                       "check the unit of emission")});
  }
  if (const int64_t count = CountHighReflectance(*patches); count > 0) {
    patches->warnings.push_back(
        {"REFLECTANCE_HIGH", absl::StrCat(count,
                                          " patch(es) reflect more than 95 %, more than any "
                                          "paint: light will bounce for long")});
  }
  AppendLightsOnSurfaces(patches);
  AppendCoplanarOverlaps(patches);
  if (IsClosedAndFacesOutward(*patches)) {
    patches->warnings.push_back(
        {"POSSIBLY_INVERTED_NORMALS",
         "the surface of the scene is closed and faces outward; if it is a room, turn its winding "
         "round or pass --two-sided"});
  }
}

}  // namespace lambert
