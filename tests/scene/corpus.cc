#include "tests/scene/corpus.h"

#include <algorithm>

#include "tests/support/read_file.h"

namespace lambert {

namespace fs = std::filesystem;

std::vector<fs::path> ScenesIn(const std::string& folder) {
  std::vector<fs::path> paths;
  const fs::path root = fs::path(LAMBERT_SHARED_SCENES) / folder;
  if (!fs::is_directory(root)) return paths;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string extension = entry.path().extension();
    if (extension == ".glb" || extension == ".gltf") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

SceneBundle ReadBundle(const fs::path& path) {
  SceneBundle bundle{path.filename(), ReadFile(path), {}};
  const auto files = ListExternalFiles(bundle.main_name, bundle.main_bytes);
  if (!files.ok()) return bundle;
  for (const std::string& file : *files) {
    if (fs::is_regular_file(path.parent_path() / file)) {
      bundle.files[file] = ReadFile(path.parent_path() / file);
    }
  }
  return bundle;
}

}  // namespace lambert
