#include "radiosity/scene/gltf_forest.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

absl::Status NodeError(int node, const std::string& message) {
  return SceneError(absl::StrCat("node ", node), message, kExportAgain);
}

// Checks that the nodes are a forest; then every node is reached at most once from its root.
absl::Status CheckForest(const tinygltf::Model& model, std::vector<int>* roots) {
  const int count = static_cast<int>(model.nodes.size());
  std::vector<int> parent(count, -1);
  for (int i = 0; i < count; ++i) {
    for (int child : model.nodes[i].children) {
      if (child < 0 || child >= count) {
        return NodeError(i, absl::StrCat("its child ", child, " does not exist"));
      }
      if (parent[child] >= 0) return NodeError(child, "it has two parents");
      parent[child] = i;
    }
  }
  std::vector<int> reached;
  for (int i = 0; i < count; ++i) {
    if (parent[i] < 0) reached.push_back(i);
  }
  *roots = reached;
  for (size_t k = 0; k < reached.size(); ++k) {
    const std::vector<int>& children = model.nodes[reached[k]].children;
    reached.insert(reached.end(), children.begin(), children.end());
  }
  if (static_cast<int>(reached.size()) == count) return absl::OkStatus();
  // What no root reaches hangs below a cycle.
  std::sort(reached.begin(), reached.end());
  int lost = 0;
  while (lost < static_cast<int>(reached.size()) && reached[lost] == lost) ++lost;
  return NodeError(lost, "it is inside itself");
}

}  // namespace

absl::Status FindRoots(const tinygltf::Model& model, std::vector<int>* roots) {
  std::vector<int> all_roots;
  absl::Status status = CheckForest(model, &all_roots);
  if (!status.ok()) return status;
  *roots = all_roots;
  if (model.scenes.empty()) return absl::OkStatus();
  const int index = std::max(model.defaultScene, 0);
  if (index >= static_cast<int>(model.scenes.size())) {
    return SceneError("scene", absl::StrCat("scene ", index, " does not exist"), kExportAgain);
  }
  *roots = model.scenes[index].nodes;
  std::vector<int> sorted = *roots;
  std::sort(sorted.begin(), sorted.end());
  for (size_t k = 0; k < sorted.size(); ++k) {
    if (!std::binary_search(all_roots.begin(), all_roots.end(), sorted[k])) {
      return SceneError(absl::StrCat("scene ", index),
                        absl::StrCat("its node ", sorted[k], " does not exist or has a parent"),
                        kExportAgain);
    }
    if (k > 0 && sorted[k] == sorted[k - 1]) {
      return SceneError(absl::StrCat("scene ", index),
                        absl::StrCat("it names node ", sorted[k], " twice"), kExportAgain);
    }
  }
  return absl::OkStatus();
}

}  // namespace lambert
