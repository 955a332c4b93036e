#include "radiosity/patch/build_patches.h"

#include <algorithm>
#include <limits>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/cut_crossings.h"
#include "radiosity/patch/patch_builder.h"
#include "radiosity/patch/patch_material.h"
#include "radiosity/patch/patch_warnings.h"
#include "radiosity/patch/place.h"
#include "radiosity/patch/shape.h"
#include "radiosity/patch/split.h"

namespace lambert {
namespace {

// Squares of lengths have to fit into the float32 of the tracer, with room for their sums.
constexpr double kMostExtent_m = 1e18;

// What is known of a scene before any patch is made.
struct Survey {
  Vec3 origin;  // centre of the bounding box of all triangles
  int64_t triangles = 0;
  double pieces = 0;  // that splitting will make at least
};

absl::StatusOr<Survey> SurveyScene(const Scene& scene, const PatchOptions& options) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Bounds bounds{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
  Survey survey;
  absl::Status status =
      ForEachTriangle(scene, {{}, options.metres_per_unit}, [&](const PlacedTriangle& placed) {
        const Shape shape = Measure(placed.corners);
        if (!std::isfinite(shape.longest_edge_m) || !std::isfinite(shape.area_m2)) {
          return SceneError(Where(placed.source), "its world position or its area is not finite",
                            "check the transforms of the node and its parents");
        }
        for (const Vec3& p : placed.corners) bounds.Add(p);
        ++survey.triangles;
        survey.pieces += options.max_edge_m > 0 ? MinimumPieces(shape.area_m2, shape.longest_edge_m,
                                                                options.max_edge_m)
                                                : 1;
        return absl::OkStatus();
      });
  if (!status.ok()) return status;
  if (survey.pieces > static_cast<double>(options.max_patches)) {
    return TooManyPatches(options.max_patches);
  }
  if (survey.triangles == 0) return survey;
  if (!(Length(bounds.high - bounds.low) <= kMostExtent_m)) {
    return SceneError("scene", absl::StrCat("it is larger than ", kMostExtent_m, " m"),
                      "check its positions and transforms, or scale it down");
  }
  survey.origin = bounds.low / 2 + bounds.high / 2;
  return survey;
}

absl::Status AddLights(const Scene& scene, const LightOptions& options, const Placement& placement,
                       PatchSet* patches) {
  const absl::StatusOr<std::vector<Light>> lights = LightsOf(scene, options);
  if (!lights.ok()) return lights.status();
  for (size_t k = 0; k < lights->size(); ++k) {
    Light light = (*lights)[k];
    light.position = placement.Place(light.position);
    const Rgb i = light.strength;
    if (!IsFinite(light.position) || !IsFinite(i) || i.r < 0 || i.g < 0 || i.b < 0) {
      return SceneError(absl::StrCat("light ", k),
                        "its position or intensity is not finite, or its intensity is negative",
                        "give it finite values of 0 or more");
    }
    patches->lights.push_back(light);
  }
  return absl::OkStatus();
}

void AddAnnotations(const Scene& scene, const Placement& placement, PatchSet* patches) {
  patches->node_names = scene.node_names;
  patches->cameras = scene.cameras;
  for (Camera& camera : patches->cameras) {
    camera.world.translation = placement.Place(camera.world.translation);
    camera.half_height_m *= placement.metres_per_unit;
  }
}

absl::Status NoTriangles(const PatchBuilder& builder) {
  std::string message = "it holds no triangles", advice = "add a mesh to the default scene";
  if (builder.cut() > 0) {
    message = absl::StrCat("alpha mode MASK cuts all of its ", builder.cut(), " patches away");
    advice = "give a smaller --max-edge, or lower the alphaCutoff of a material";
  } else if (builder.omitted() > 0) {
    message = absl::StrCat("all of its ", builder.omitted(), " triangles are of alpha mode BLEND");
    advice = "give --blend opaque";
  } else if (builder.degenerate() > 0) {
    message = absl::StrCat("all of its ", builder.degenerate(), " triangles are without area");
  }
  return MakeError(absl::StatusCode::kInvalidArgument, {"NO_TRIANGLES", "scene", message, advice});
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
  if (!std::isfinite(metres_per_unit) || !(metres_per_unit > 0)) {
    return invalid("metres_per_unit", "give a number over 0");
  }
  if (max_patches < 1 || max_patches > std::numeric_limits<PatchIndex>::max()) {
    return invalid("max_patches", "give a number from 1 to 2147483647");
  }
  if (adapt_patches < 0) return invalid("adapt_patches", "give a number of 0 or more");
  return lights.Validate();
}

Cuts FindCrossings(const Scene& scene, const PatchOptions& options, int64_t most_pieces) {
  if (most_pieces <= 0) return {};
  const absl::StatusOr<Survey> survey = SurveyScene(scene, options);
  if (!survey.ok()) return {};
  std::vector<std::array<Vec3, 3>> triangles;
  const auto add = [&](const PlacedTriangle& triangle) {
    const int material = triangle.primitive->material;
    const bool is_omitted = material >= 0 && IsOmitted(scene.materials[material], options);
    // What is left out cuts nothing, as what has no area.
    triangles.push_back(is_omitted ? std::array<Vec3, 3>{} : triangle.corners);
    return absl::OkStatus();
  };
  const absl::Status placed =
      ForEachTriangle(scene, {survey->origin, options.metres_per_unit}, add);
  return placed.ok() ? Cuts{CutCrossings(triangles, most_pieces), {}} : Cuts();
}

absl::StatusOr<PatchSet> BuildPatches(const Scene& scene, const PatchOptions& options,
                                      const Cuts& cuts) {
  absl::Status status = options.Validate();
  if (!status.ok()) return status;
  std::vector<Warning> warnings = scene.warnings;
  absl::StatusOr<std::vector<PatchMaterial>> materials =
      MakePatchMaterials(scene, options, &warnings);
  if (!materials.ok()) return materials.status();
  absl::StatusOr<Survey> survey = SurveyScene(scene, options);
  if (!survey.ok()) return survey.status();

  PatchBuilder builder(*materials, scene.textures, options, cuts, survey->pieces);
  const Placement placement{survey->origin, options.metres_per_unit};
  status = ForEachTriangle(scene, placement,
                           [&](const PlacedTriangle& placed) { return builder.Add(placed); });
  if (!status.ok()) return status;
  PatchSet patches = builder.Finish();
  if (patches.size() == 0) return NoTriangles(builder);
  patches.origin = survey->origin;
  patches.warnings.insert(patches.warnings.begin(), warnings.begin(), warnings.end());
  status = AddLights(scene, options.lights, placement, &patches);
  if (!status.ok()) return status;
  if (!IsFinite(EmittedFlux(patches))) {
    return SceneError("scene", "its emitted flux is too large for a number",
                      "scale its emission or its size down");
  }
  AddAnnotations(scene, placement, &patches);
  AppendPatchWarnings(&patches);
  return patches;
}

}  // namespace lambert
