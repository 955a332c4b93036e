// Scenes that others made, beside the project: skipped where they are not there.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/support/read_file.h"

namespace lambert {
namespace {

namespace fs = std::filesystem;

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

absl::StatusOr<PatchSet> Load(const fs::path& path, const PatchOptions& options = {}) {
  absl::StatusOr<Scene> scene = LoadGltf(ReadBundle(path));
  if (!scene.ok()) return scene.status();
  return BuildPatches(*scene, options);
}

void ExpectUsable(const PatchSet& patches) {
  // The codec refuses whatever is not finite or out of range.
  EXPECT_TRUE(DecodePatchSet(EncodePatchSet(patches)).ok());
}

TEST(Corpus, EveryConformanceFileLoadsOrIsRefusedByName) {
  const std::vector<fs::path> paths = ScenesIn("conformance");
  if (paths.empty()) GTEST_SKIP() << "no conformance scenes";
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.filename());
    const absl::StatusOr<Scene> scene = LoadGltf(ReadBundle(path));
    if (!scene.ok()) {
      const std::string message(scene.status().message());
      EXPECT_TRUE(message.find("requires") != std::string::npos ||
                  message.find("needs glTF") != std::string::npos)
          << message;
      std::cout << message << "\n";
      continue;
    }
    const absl::StatusOr<PatchSet> patches = BuildPatches(*scene, {});
    if (patches.ok()) {
      ExpectUsable(*patches);
    } else {
      std::cout << path.filename() << ": " << patches.status().message() << "\n";
      EXPECT_EQ(ReasonOf(patches.status()), "NO_TRIANGLES") << patches.status();
    }
  }
}

TEST(Corpus, RealAndStiffScenesBecomePatches) {
  std::vector<fs::path> paths = ScenesIn("stiff");
  for (const fs::path& path : ScenesIn("real")) paths.push_back(path);
  if (paths.empty()) GTEST_SKIP() << "no real scenes";
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.filename());
    const absl::StatusOr<PatchSet> patches = Load(path);
    ASSERT_TRUE(patches.ok()) << patches.status();
    ExpectUsable(*patches);
  }
}

TEST(Corpus, HostileFilesEndSoonWithPatchesOrOneLine) {
  const std::vector<fs::path> paths = ScenesIn("hostile");
  if (paths.empty()) GTEST_SKIP() << "no hostile scenes";
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path.string());
    const auto begin = std::chrono::steady_clock::now();
    const absl::StatusOr<PatchSet> patches = Load(path);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
    if (patches.ok()) {
      ExpectUsable(*patches);
      continue;
    }
    EXPECT_TRUE(GetErrorDetail(patches.status()).has_value()) << patches.status();
    EXPECT_EQ(patches.status().message().find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace lambert
