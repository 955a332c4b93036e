#include "app/bench_pictures.h"

#include <algorithm>
#include <cmath>

#include "app/gnuplot.h"
#include "app/progress_text.h"
#include "fmt/format.h"
#include "radiosity/output/output_file.h"
#include "radiosity/output/picture.h"
#include "radiosity/output/png.h"

namespace lambert::app {
namespace {

// Layout of the mounted picture, pixels.
constexpr int kLongerSide = 400, kGap = 10, kLabel = 26, kTop = 58, kColumns = 4;
constexpr double kEnlargement = 3;  // of a detail where no region is named

struct Shown {
  std::string label;
  std::string stem;  // of its files
  const Solution* solution;
};

// The reference, then the methods.
std::vector<Shown> WhatIsShown(const BenchResult& result) {
  std::vector<Shown> shown = {{"reference", "reference", result.reference_solution.get()}};
  for (size_t k = 0; k < result.entries.size(); ++k) {
    if (result.pictured[k] == nullptr) continue;
    std::string stem = result.entries[k].label;
    std::replace_if(
        stem.begin(), stem.end(), [](char c) { return c == ':' || c == '=' || c == '/'; }, '_');
    shown.push_back({result.entries[k].label, stem, result.pictured[k].get()});
  }
  return shown;
}

// The box around the patches of the region.
Bounds RegionBounds(const BenchResult& result) {
  PatchSet region;
  for (PatchIndex i = 0; i < result.patches->size(); ++i) {
    if (result.region_nodes.count(result.patches->source[i].node) == 0) continue;
    region.corners.push_back(result.patches->corners[i]);
  }
  return BoundsOf(region);
}

std::string MountScript(const BenchResult& result, const std::vector<Shown>& shown,
                        const Picture& size) {
  const int columns = std::min<int>(kColumns, static_cast<int>(shown.size()));
  const int rows = (static_cast<int>(shown.size()) + columns - 1) / columns;
  const int cell_width = size.width + kGap, cell_height = kLabel + 2 * (size.height + kGap);
  const int width = columns * cell_width + kGap, height = kTop + rows * cell_height;
  std::string text =
      GnuplotTerminal("methods", width, height) +
      GnuplotHeadline(
          fmt::format("{}: {}, one run of each method", result.name, result.pictured_budget),
          result.region_nodes.empty() ? "whole, and the middle three times as large"
                                      : "whole, and the region seen near",
          kGap, width, height) +
      "unset border\nunset tics\nunset key\nunset grid\n" +
      fmt::format("set xrange [-0.5:{}.5]\nset yrange [-0.5:{}.5]\n", size.width - 1,
                  size.height - 1);
  for (int k = 0; k < static_cast<int>(shown.size()); ++k) {
    const int left = kGap + k % columns * cell_width, top = kTop + k / columns * cell_height;
    text += fmt::format("\nset label 3 {} at screen {:.5f},{:.5f} left noenhanced font ',11'\n",
                        GnuplotQuoted(shown[k].label), static_cast<double>(left) / width,
                        1 - (top + kLabel / 2.0) / height);
    int picture_top = top + kLabel;
    for (const char* part : {"whole", "detail"}) {
      text += GnuplotPlace(left, picture_top, size.width, size.height, width, height);
      text += fmt::format("plot {} binary filetype=png with rgbimage notitle\nunset label\n",
                          GnuplotQuoted(fmt::format("{}_{}.png", shown[k].stem, part)));
      picture_top += size.height + kGap;
    }
  }
  return text + "unset multiplot\nset output\n";
}

}  // namespace

absl::StatusOr<std::vector<std::string>> DrawPictures(const BenchResult& result,
                                                      const std::string& folder) {
  if (absl::Status status = MakeOutputFolder(folder); !status.ok()) return status;
  const PatchSet& patches = *result.patches;
  auto scene = RayScene::Create(patches);
  if (!scene.ok()) return scene.status();
  const View whole = ChooseView(patches, **scene, result.reference_solution->radiosity_lm_per_m2);
  const View detail = result.region_nodes.empty() ? Enlarged(whole, kEnlargement)
                                                  : CloseUp(whole, RegionBounds(result));
  const std::vector<Shown> shown = WhatIsShown(result);
  PictureOptions options;  // the exposure of the whole reference, for all
  Picture picture;
  for (const Shown& one : shown) {
    const auto flat = FlatIrradiance(one.solution->irradiance_lx);
    for (const auto& [part, view] : {std::pair{"whole", whole}, {"detail", detail}}) {
      picture = DrawPicture(view, patches, **scene, *one.solution, {patches, nullptr}, flat,
                            kLongerSide, options);
      options.exposure_per_lm_per_m2 = picture.exposure.per_lm_per_m2;
      absl::Status status =
          WriteOutputFile(fmt::format("{}/{}_{}.png", folder, one.stem, part),
                          EncodePng(picture.width, picture.height, picture.display));
      if (!status.ok()) return status;
    }
  }
  absl::Status status =
      WriteOutputFile(folder + "/methods.gp", MountScript(result, shown, picture));
  if (status.ok()) status = RunGnuplot(folder, "methods.gp", {"png"});
  if (!status.ok()) return status;
  return std::vector<std::string>{folder + "/methods.png"};
}

}  // namespace lambert::app
