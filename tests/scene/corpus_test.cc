// Scenes that others made, beside the project: skipped where they are not there.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "tests/scene/corpus.h"

namespace lambert {
namespace {

namespace fs = std::filesystem;

absl::StatusOr<PatchSet> Load(const fs::path& path, const PatchOptions& options = {}) {
  absl::StatusOr<Scene> scene = LoadGltf(ReadBundle(path));
  if (!scene.ok()) return scene.status();
  return BuildPatches(*scene, options);
}

void ExpectUsable(const PatchSet& patches) {
  // The codec refuses whatever is not finite or out of range.
  EXPECT_TRUE(DecodePatchSet(EncodePatchSet(patches)).ok());
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
