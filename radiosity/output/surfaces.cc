#include "radiosity/output/surfaces.h"

#include <algorithm>
#include <map>

#include "radiosity/output/exposure.h"

namespace lambert {

std::vector<Surface> ListSurfaces(const PatchSet& patches, const Solution& solution) {
  std::map<int32_t, Surface> by_node;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    Surface& surface = by_node[patches.source[i].node];
    const double irradiance = Luminance(solution.irradiance_lx[i]);
    const bool first = surface.patches == 0;
    surface.least_lx = first ? irradiance : std::min(surface.least_lx, irradiance);
    surface.most_lx = first ? irradiance : std::max(surface.most_lx, irradiance);
    ++surface.patches;
    surface.area_m2 += patches.area_m2[i];
    surface.mean_lx += patches.area_m2[i] * irradiance;
    surface.mean_reflectance += patches.area_m2[i] * Luminance(patches.reflectance[i]);
  }
  std::vector<Surface> surfaces;
  for (auto& [node, surface] : by_node) {
    const size_t named = static_cast<size_t>(node);
    if (named < patches.node_names.size()) surface.name = patches.node_names[named];
    if (surface.name.empty()) surface.name = "node " + std::to_string(node);
    surface.mean_lx /= surface.area_m2;
    surface.mean_reflectance /= surface.area_m2;
    surfaces.push_back(std::move(surface));
  }
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const Surface& a, const Surface& b) { return a.area_m2 > b.area_m2; });
  return surfaces;
}

}  // namespace lambert
