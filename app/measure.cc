#include "app/measure.h"

#include <algorithm>
#include <utility>

#include "app/exit.h"
#include "app/settings.h"

namespace lambert::app {

namespace {

constexpr size_t kListedNodes = 20;

// "give one of its nodes: 0 (floor), 1 (desk), 2, ..."
std::string NodeChoices(const std::vector<std::string>& node_names) {
  std::string text;
  for (size_t node = 0; node < std::min(node_names.size(), kListedNodes); ++node) {
    text += (node == 0 ? "" : ", ") + std::to_string(node);
    if (!node_names[node].empty()) text += " (" + node_names[node] + ")";
  }
  if (node_names.size() > kListedNodes) {
    text += " ... " + std::to_string(node_names.size() - 1);
  }
  return "give the index or the name of one of its nodes: " + text;
}

}  // namespace

absl::StatusOr<std::set<int>> FindRegions(const std::vector<std::string>& regions,
                                          const std::vector<std::string>& node_names) {
  std::set<int> nodes;
  for (const std::string& region : regions) {
    const std::vector<int32_t> called = NodesCalled(node_names, region);
    if (!called.empty()) {
      nodes.insert(called.begin(), called.end());
      continue;
    }
    const std::string nearest = NearestWord(region, node_names);
    return UsageError("--region", "the scene has no node '" + region + "'",
                      nearest.empty() ? NodeChoices(node_names) : "did you mean '" + nearest + "'");
  }
  return nodes;
}

absl::StatusOr<Measurer> Measurer::Create(const std::string& reference_path,
                                          const std::vector<std::string>& regions) {
  Measurer measurer;
  measurer.regions_ = regions;
  if (reference_path.empty()) return measurer;
  auto table = ReadPatchTable(reference_path);
  if (!table.ok()) return table.status();
  measurer.reference_ = *std::move(table);
  return measurer;
}

absl::StatusOr<ErrorMeasures> Measurer::Measure(const PatchSet& patches,
                                                const Solution& solution) const {
  auto nodes = FindRegions(regions_, patches.node_names);
  if (!nodes.ok()) return nodes.status();
  return Compare(MakePatchTable(patches, solution), *reference_, *nodes);
}

}  // namespace lambert::app
