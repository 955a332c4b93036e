#include "radiosity/patch/build_patches.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/morton.h"
#include "radiosity/patch/patch_warnings.h"
#include "radiosity/patch/place.h"
#include "radiosity/patch/split.h"
#include "radiosity/patch/surface.h"
#include "radiosity/patch/texture_mean.h"

namespace lambert {
namespace {

// Texture samples of a whole scene: about a third of a second of one core. Scenes of many patches get fewer
// along each edge (and their patches cover fewer texels).
constexpr double kTextureSamples = 3e7;
constexpr double kLeastSamplesPerEdge = 4, kMostSamplesPerEdge = 512;

std::string Where(const PatchSource& source) {
  return absl::StrCat("node ", source.node, ", mesh ", source.mesh, ", primitive ",
                      source.primitive, ", triangle ", source.triangle);
}

absl::Status TooManyPatches(int64_t most) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", "scene", absl::StrCat("more than ", most, " patches"),
                    "give a larger --max-edge or a smaller scene"});
}

struct Shape {
  double longest_edge_m = 0;
  double area_m2 = 0;
};

Shape Measure(const std::array<Vec3, 3>& corners) {
  const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  return {std::max({Length(ab), Length(ac), Length(corners[2] - corners[1])}),
          Length(Cross(ab, ac)) / 2};
}

// True where a triangle is a line or a point up to the rounding of its corners: moving a corner by
// its last bits changes the area by that much times the longest edge. Slivers of one part in 1e12
// are thicker than that and stay. (s07 of any size: no length is absolute.)
bool IsDegenerate(const std::array<Vec3, 3>& corners, const Shape& shape) {
  const double farthest_m =
      std::max({Length(corners[0]), Length(corners[1]), Length(corners[2])});
  const double rounding_m = 4 * std::numeric_limits<double>::epsilon() * farthest_m;
  return !(shape.area_m2 > rounding_m * shape.longest_edge_m);
}

// What is known of a scene before any patch is made.
struct Survey {
  Vec3 origin;         // centre of the bounding box of all triangles
  int64_t triangles = 0;
  double pieces = 0;   // that splitting will make at least
};

absl::StatusOr<Survey> SurveyScene(const Scene& scene, const PatchOptions& options) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -low;
  Survey survey;
  absl::Status status = ForEachTriangle(scene, {}, [&](const PlacedTriangle& placed) {
    const Shape shape = Measure(placed.corners);
    if (!std::isfinite(shape.longest_edge_m) || !std::isfinite(shape.area_m2)) {
      return SceneError(Where(placed.source), "its world position or its area is not finite",
                        "check the transforms of the node and its parents");
    }
    for (const Vec3& p : placed.corners) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    ++survey.triangles;
    survey.pieces += options.max_edge_m > 0
                         ? MinimumPieces(shape.area_m2, shape.longest_edge_m, options.max_edge_m)
                         : 1;
    return absl::OkStatus();
  });
  if (!status.ok()) return status;
  if (survey.pieces > static_cast<double>(options.max_patches)) {
    return TooManyPatches(options.max_patches);
  }
  if (survey.triangles > 0) survey.origin = low / 2 + high / 2;
  return survey;
}

// Collects front sides in the order of the scene, then makes the sorted set.
class PatchBuilder {
 public:
  PatchBuilder(const std::vector<Surface>& surfaces, const PatchOptions& options,
               const Survey& survey)
      : surfaces_(surfaces), options_(options), samples_per_edge_(SamplesPerEdge(survey)) {}

  absl::Status Add(const PlacedTriangle& placed) {
    if (IsDegenerate(placed.corners, Measure(placed.corners))) {
      ++degenerate_;
      return absl::OkStatus();
    }
    pieces_.clear();
    SplitTriangle(placed.corners, options_.max_edge_m, &pieces_);
    for (const SplitPiece& piece : pieces_) {
      absl::Status status = AddPiece(placed, piece);
      if (!status.ok()) return status;
    }
    return absl::OkStatus();
  }

  int64_t degenerate() const { return degenerate_; }

  // The corners, surfaces and sources of all patches, sorted. The builder is used up.
  PatchSet Finish();

 private:
  static int SamplesPerEdge(const Survey& survey) {
    return static_cast<int>(std::clamp(std::sqrt(kTextureSamples / std::max(1.0, survey.pieces)),
                                       kLeastSamplesPerEdge, kMostSamplesPerEdge));
  }

  absl::Status AddPiece(const PlacedTriangle& placed, const SplitPiece& piece);
  absl::StatusOr<Rgb> Mean(const PlacedTriangle& placed, const SplitPiece& piece,
                           const Texture* texture, int uv_set) const;

  const std::vector<Surface>& surfaces_;
  const PatchOptions& options_;
  const int samples_per_edge_;
  std::vector<SplitPiece> pieces_;   // of the triangle in hand
  PatchSet fronts_;                  // twin: kNoPatch, or 0 where there is a back to make
  int64_t patches_ = 0;              // backs included
  int64_t degenerate_ = 0;
};

absl::StatusOr<Rgb> PatchBuilder::Mean(const PlacedTriangle& placed, const SplitPiece& piece,
                                       const Texture* texture, int uv_set) const {
  if (texture == nullptr) return Rgb{1, 1, 1};
  const auto& coordinates = placed.primitive->uv[uv_set];
  if (coordinates.empty()) {
    return SceneError(Where(placed.source),
                      absl::StrCat("its material has a texture, but it has no TEXCOORD_", uv_set),
                      "export texture coordinates, or take the texture off the material");
  }
  std::array<Uv, 3> uv;
  for (int k = 0; k < 3; ++k) {
    const Vec3 w = piece[k].barycentric;
    for (int axis = 0; axis < 2; ++axis) {
      uv[k][axis] = w.x * coordinates[placed.vertices[0]][axis] +
                    w.y * coordinates[placed.vertices[1]][axis] +
                    w.z * coordinates[placed.vertices[2]][axis];
      if (!std::isfinite(uv[k][axis])) {
        return SceneError(Where(placed.source), "a texture coordinate is not finite",
                          "export the file again");
      }
    }
  }
  return TextureMean(*texture, uv, samples_per_edge_);
}

absl::Status PatchBuilder::AddPiece(const PlacedTriangle& placed, const SplitPiece& piece) {
  const std::array<Vec3, 3> corners = {piece[0].position, piece[1].position, piece[2].position};
  const double area_m2 = Measure(corners).area_m2;
  if (!(area_m2 > 0)) return absl::OkStatus();
  const Surface& surface = surfaces_[placed.primitive->material + 1];
  patches_ += surface.two_sided ? 2 : 1;
  if (patches_ > options_.max_patches) return TooManyPatches(options_.max_patches);
  absl::StatusOr<Rgb> rho =
      Mean(placed, piece, surface.reflectance_texture, surface.reflectance_uv);
  if (!rho.ok()) return rho.status();
  absl::StatusOr<Rgb> emitted =
      Mean(placed, piece, surface.exitance_texture, surface.exitance_uv);
  if (!emitted.ok()) return emitted.status();
  fronts_.corners.push_back(corners);
  fronts_.area_m2.push_back(area_m2);
  fronts_.reflectance.push_back(surface.reflectance * *rho);
  fronts_.exitance_lm_per_m2.push_back(surface.exitance_lm_per_m2 * *emitted);
  fronts_.twin.push_back(surface.two_sided ? 0 : kNoPatch);
  fronts_.source.push_back(placed.source);
  return absl::OkStatus();
}

PatchSet PatchBuilder::Finish() {
  std::vector<Vec3> centroids(fronts_.size());
  for (PatchIndex i = 0; i < fronts_.size(); ++i) centroids[i] = PatchCentroid(fronts_, i);
  const std::vector<uint64_t> codes = MortonCodes(centroids);
  std::vector<PatchIndex> order(fronts_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&codes](PatchIndex a, PatchIndex b) { return codes[a] < codes[b]; });
  PatchSet sorted;
  sorted.corners.reserve(patches_);
  for (PatchIndex front : order) {
    const bool two_sided = fronts_.twin[front] != kNoPatch;
    for (int back = 0; back < (two_sided ? 2 : 1); ++back) {
      const PatchIndex here = sorted.size();
      auto [a, b, c] = fronts_.corners[front];
      sorted.corners.push_back(back ? std::array{a, c, b} : std::array{a, b, c});
      sorted.area_m2.push_back(fronts_.area_m2[front]);
      sorted.reflectance.push_back(fronts_.reflectance[front]);
      sorted.exitance_lm_per_m2.push_back(fronts_.exitance_lm_per_m2[front]);
      sorted.twin.push_back(!two_sided ? kNoPatch : back ? here - 1 : here + 1);
      sorted.is_back.push_back(static_cast<uint8_t>(back));
      sorted.source.push_back(fronts_.source[front]);
    }
  }
  fronts_ = {};
  return sorted;
}

absl::Status AddLights(const Scene& scene, PatchSet* patches) {
  for (PointLight light : scene.point_lights) {
    light.position = light.position - patches->origin;
    const Rgb i = light.intensity_cd;
    if (!IsFinite(light.position) || !IsFinite(i) || i.r < 0 || i.g < 0 || i.b < 0) {
      return SceneError(absl::StrCat("light \"", light.name, "\""),
                        "its position or intensity is not finite, or its intensity is negative",
                        "give it finite values of 0 or more");
    }
    patches->point_lights.push_back(light);
  }
  return absl::OkStatus();
}

void AddAnnotations(const Scene& scene, PatchSet* patches) {
  patches->node_names = scene.node_names;
  patches->cameras = scene.cameras;
  for (Camera& camera : patches->cameras) {
    camera.world.translation = camera.world.translation - patches->origin;
  }
}

absl::Status NoTriangles(int64_t degenerate) {
  const std::string message =
      degenerate > 0 ? absl::StrCat("all of its ", degenerate, " triangles are without area")
                     : "it holds no triangles";
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"NO_TRIANGLES", "scene", message, "add a mesh to the default scene"});
}

}  // namespace

absl::Status PatchOptions::Validate() const {
  const auto invalid = [](const std::string& field, const std::string& rule) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", field, "out of range", rule});
  };
  if (!std::isfinite(max_edge_m) || max_edge_m < 0) {
    return invalid("max_edge_m", "give metres over 0, or 0 to split nothing");
  }
  if (max_patches < 1 || max_patches > std::numeric_limits<PatchIndex>::max()) {
    return invalid("max_patches", "give a number from 1 to 2147483647");
  }
  return absl::OkStatus();
}

absl::StatusOr<PatchSet> BuildPatches(const Scene& scene, const PatchOptions& options) {
  absl::Status status = options.Validate();
  if (!status.ok()) return status;
  std::vector<Warning> warnings = scene.warnings;
  absl::StatusOr<std::vector<Surface>> surfaces =
      MakeSurfaces(scene, options.two_sided, &warnings);
  if (!surfaces.ok()) return surfaces.status();
  absl::StatusOr<Survey> survey = SurveyScene(scene, options);
  if (!survey.ok()) return survey.status();

  PatchBuilder builder(*surfaces, options, *survey);
  status = ForEachTriangle(scene, survey->origin,
                           [&](const PlacedTriangle& placed) { return builder.Add(placed); });
  if (!status.ok()) return status;
  PatchSet patches = builder.Finish();
  if (patches.size() == 0) return NoTriangles(builder.degenerate());
  if (builder.degenerate() > 0) {
    warnings.push_back({"ZERO_AREA_PATCHES", absl::StrCat(builder.degenerate(),
                                                          " triangle(s) without area left out")});
  }
  patches.origin = survey->origin;
  patches.warnings = std::move(warnings);
  status = AddLights(scene, &patches);
  if (!status.ok()) return status;
  AddAnnotations(scene, &patches);
  AppendPatchWarnings(&patches);
  return patches;
}

}  // namespace lambert
