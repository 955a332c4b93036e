// What base textures are multiplied by to show their light.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "radiosity/lightmap/placed_scene.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/glb_writer.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/texture_mean.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// Of the patches of one scene. The arguments of the constructor must outlive it.
class TextureLight {
 public:
  // A null scene has no textures. Requires: patches and light of that scene.
  TextureLight(const PatchSet& patches, const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
               const Exposure& exposure, const Scene* scene);

  // The material whose base texture patch i shows, or -1: it has none, or emits otherwise than
  // through it.
  int MaterialOf(PatchIndex i) const { return material_[i]; }
  // How much brighter than it is the texture has to be there: 1 to 16.
  double GainOf(PatchIndex i) const { return gain_[i]; }

  struct Corner {
    Rgb color;  // times the brighter texture: the picture; over 1 where the gain is too small
    double alpha = 1;
    Uv uv{};  // of the texture as MakeMaterial stores it
  };
  // Requires: MaterialOf(i) >= 0.
  Corner At(PatchIndex i, int corner) const;

  // By texture of the scene and gain: the file's texture.
  using Copies = std::map<std::pair<int, double>, size_t>;
  // An unlit material with the texture times a gain (in its extras), which `copies` has or gets.
  GlbWriter::Json MakeMaterial(int material, double gain, Copies& copies, GlbWriter& writer) const;

 private:
  double ChooseGain(PatchIndex i) const;
  Corner Ungained(PatchIndex i, int corner) const;

  const PatchSet& patches_;
  const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx_;
  const Exposure exposure_;
  const Scene* const scene_;
  PlacedScene placed_;
  std::vector<int32_t> triangle_;  // by patch
  std::vector<int> material_;      // by patch
  std::vector<double> gain_;       // by patch
};

}  // namespace lambert
