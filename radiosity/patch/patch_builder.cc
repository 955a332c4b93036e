#include "radiosity/patch/patch_builder.h"

#include <algorithm>
#include <numeric>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/patch/duplicates.h"
#include "radiosity/patch/morton.h"
#include "radiosity/patch/shape.h"

namespace lambert {
namespace {

// Texture samples of a whole scene: about a third of a second of one core. Scenes of many patches
// get fewer along each edge (and their patches cover fewer texels).
constexpr double kTextureSamples = 3e7;
constexpr double kLeastSamplesPerEdge = 4, kMostSamplesPerEdge = 512;

// A patch is there, whole, or it is not: what alpha mode MASK leaves half of stays.
constexpr double kLeastCoverage = 0.5;

int SamplesPerEdge(double expected_patches) {
  return static_cast<int>(std::clamp(std::sqrt(kTextureSamples / std::max(1.0, expected_patches)),
                                     kLeastSamplesPerEdge, kMostSamplesPerEdge));
}

// The texture coordinates of a piece's corners.
absl::StatusOr<std::array<Uv, 3>> UvOf(const PlacedTriangle& placed, const SplitPiece& piece,
                                       const TextureUse& use) {
  if (!placed.primitive->uv.contains(use.uv_set)) {
    return SceneError(
        Where(placed.source),
        absl::StrCat("its material has a texture, but it has no TEXCOORD_", use.uv_set),
        "export texture coordinates, or take the texture off the material");
  }
  std::array<Uv, 3> uv;
  for (int k = 0; k < 3; ++k) {
    uv[k] = UvAt(use, *placed.primitive, placed.vertices, piece[k].barycentric);
    if (!std::isfinite(uv[k][0]) || !std::isfinite(uv[k][1])) {
      return SceneError(Where(placed.source), "a texture coordinate is not finite",
                        "export the file again");
    }
  }
  return uv;
}

}  // namespace

absl::Status TooManyPatches(int64_t most) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", "scene", absl::StrCat("more than ", most, " patches"),
                    "give a larger --max-edge or a smaller scene"});
}

std::string Where(const PatchSource& source) {
  return absl::StrCat("node ", source.node, ", mesh ", source.mesh, ", primitive ",
                      source.primitive, ", triangle ", source.triangle);
}

PatchBuilder::PatchBuilder(const std::vector<PatchMaterial>& materials,
                           const std::vector<Texture>& textures, const PatchOptions& options,
                           const Cuts& cuts, double expected_patches)
    : materials_(materials),
      textures_(textures),
      options_(options),
      cuts_(cuts),
      samples_per_edge_(SamplesPerEdge(expected_patches)) {}

absl::Status PatchBuilder::Add(const PlacedTriangle& placed) {
  const auto crossed = cuts_.crossed.find(triangles_++);
  if (materials_[placed.primitive->material + 1].omitted) {
    ++omitted_;
    return absl::OkStatus();
  }
  if (IsDegenerate(placed.corners, Measure(placed.corners))) {
    ++degenerate_;
    return absl::OkStatus();
  }
  pieces_.clear();
  if (crossed == cuts_.crossed.end()) {
    SplitLongEdges(WholePiece(placed.corners), options_.max_edge_m, &pieces_);
  } else {
    for (const SplitPiece& piece : crossed->second) {
      SplitLongEdges(piece, options_.max_edge_m, &pieces_);
    }
  }
  for (const EdgeMarks& marks : cuts_.levels) HalveMarked(marks, &pieces_);
  for (const SplitPiece& piece : pieces_) {
    absl::Status status = AddPiece(placed, piece);
    if (!status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::StatusOr<PaintedTriangle> PatchBuilder::Paint(const PlacedTriangle& placed,
                                                    const SplitPiece& piece,
                                                    const TextureUse& use) const {
  PaintedTriangle painted;
  if (use.texture < 0) return painted;
  const absl::StatusOr<std::array<Uv, 3>> uv = UvOf(placed, piece, use);
  if (!uv.ok()) return uv.status();
  painted.texture = &textures_[use.texture];
  painted.uv = *uv;
  return painted;
}

absl::Status PatchBuilder::AddPiece(const PlacedTriangle& placed, const SplitPiece& piece) {
  const std::array<Vec3, 3> corners = {piece[0].position, piece[1].position, piece[2].position};
  const double area_m2 = Measure(corners).area_m2;
  if (!(area_m2 > 0)) return absl::OkStatus();
  const PatchMaterial& material = materials_[placed.primitive->material + 1];
  absl::StatusOr<PaintedTriangle> diffuse = Paint(placed, piece, material.reflectance_texture);
  if (!diffuse.ok()) return diffuse.status();
  const auto& colors = placed.primitive->colors;
  for (int k = 0; k < 3 && !colors.empty(); ++k) {
    for (int c = 0; c < 4; ++c) {
      diffuse->colors[k][c] =
          static_cast<float>(Interpolate(piece[k].barycentric, colors, placed.vertices, c));
    }
  }
  const MaskedMean reflectance =
      MeanOver(*diffuse, samples_per_edge_, material.alpha, material.alpha_cutoff);
  if (reflectance.coverage > 0 && reflectance.coverage < 1) ++partly_cut_;
  if (reflectance.coverage < kLeastCoverage) {
    ++cut_;
    return absl::OkStatus();
  }
  patches_ += material.two_sided ? 2 : 1;
  if (patches_ > options_.max_patches) return TooManyPatches(options_.max_patches);
  const absl::StatusOr<PaintedTriangle> glow = Paint(placed, piece, material.exitance_texture);
  if (!glow.ok()) return glow.status();
  fronts_.corners.push_back(corners);
  fronts_.area_m2.push_back(area_m2);
  fronts_.reflectance.push_back(material.reflectance * reflectance.mean);
  fronts_.exitance_lm_per_m2.push_back(material.exitance_lm_per_m2 *
                                       MeanOver(*glow, samples_per_edge_).mean);
  fronts_.twin.push_back(material.two_sided ? 0 : kNoPatch);
  fronts_.source.push_back(placed.source);
  return absl::OkStatus();
}

void PatchBuilder::Append(PatchIndex front, PatchSet* sorted) const {
  const bool two_sided = fronts_.twin[front] != kNoPatch;
  const PatchIndex first = sorted->size();
  const auto& [a, b, c] = fronts_.corners[front];
  for (int back = 0; back < (two_sided ? 2 : 1); ++back) {
    sorted->corners.push_back(back ? std::array{a, c, b} : std::array{a, b, c});
    sorted->area_m2.push_back(fronts_.area_m2[front]);
    sorted->reflectance.push_back(fronts_.reflectance[front]);
    sorted->exitance_lm_per_m2.push_back(fronts_.exitance_lm_per_m2[front]);
    sorted->twin.push_back(two_sided ? first + 1 - back : kNoPatch);
    sorted->is_back.push_back(static_cast<uint8_t>(back));
    sorted->source.push_back(fronts_.source[front]);
  }
}

PatchSet PatchBuilder::Finish() {
  std::vector<Vec3> centroids(fronts_.size());
  for (PatchIndex i = 0; i < fronts_.size(); ++i) centroids[i] = PatchCentroid(fronts_, i);
  const std::vector<uint64_t> codes = MortonCodes(centroids);
  std::vector<PatchIndex> order(fronts_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&codes](PatchIndex a, PatchIndex b) { return codes[a] < codes[b]; });
  const int64_t duplicates = RemoveDuplicates(fronts_.corners, codes, &order);

  PatchSet sorted;
  for (PatchIndex front : order) Append(front, &sorted);
  fronts_ = {};
  if (degenerate_ > 0) {
    sorted.warnings.push_back(
        {"ZERO_AREA_PATCHES", absl::StrCat(degenerate_, " triangle(s) without area left out")});
  }
  if (!cuts_.crossed.empty()) {
    sorted.warnings.push_back(
        {"CROSSING_PATCHES", absl::StrCat(cuts_.crossed.size(),
                                          " triangle(s) that others pass through or stand on are "
                                          "cut there")});
  }
  if (partly_cut_ > 0) {
    sorted.warnings.push_back(
        {"PARTLY_CUT_PATCHES",
         absl::StrCat("alpha mode MASK cuts parts of ", partly_cut_,
                      " patch(es) away: those cut by more than half are left out, the others are "
                      "taken as whole; give a smaller --max-edge")});
  }
  if (duplicates > 0) {
    sorted.warnings.push_back(
        {"DUPLICATE_PATCHES",
         absl::StrCat(duplicates, " patch(es) that lie exactly on another one left out")});
  }
  return sorted;
}

}  // namespace lambert
