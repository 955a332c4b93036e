#include "app/scene_files.h"

#include <filesystem>
#include <fstream>

#include "app/exit.h"
#include "gtest/gtest.h"
#include "radiosity/core/error.h"
#include "tests/support/temporary_folder.h"

namespace lambert::app {
namespace {

namespace fs = std::filesystem;

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "parts"); }
  std::string Write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return (folder_ / name).string();
  }
  std::string WriteGltf(const std::string& uri) {
    return Write("room.gltf", R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":")" +
                                  uri + R"("}]})");
  }
  const TemporaryFolder own_;
  const fs::path folder_ = own_.path();
};

TEST_F(SceneFiles, ABundleHoldsTheFilesThatTheSceneNames) {
  Write("parts/a b.bin", "abc");
  const auto bundle = ReadSceneBundle(WriteGltf("parts/a%20b.bin"));
  ASSERT_TRUE(bundle.ok()) << bundle.status();
  EXPECT_EQ(bundle->main_name, "room.gltf");
  ASSERT_EQ(bundle->files.size(), 1u);
  EXPECT_EQ(bundle->files.at("parts/a b.bin"), "abc");
}

TEST_F(SceneFiles, AMissingSceneIsNamed) {
  const auto bundle = ReadSceneBundle((folder_ / "none.glb").string());
  EXPECT_EQ(ReasonOf(bundle.status()), "SCENE_FILE_MISSING");
  EXPECT_EQ(ExitCodeFor(bundle.status()), ExitCode::kBadScene);
  EXPECT_NE(bundle.status().message().find("none.glb: No such file"), std::string::npos)
      << bundle.status();
}

TEST_F(SceneFiles, AMissingPartIsNamed) {
  const auto bundle = ReadSceneBundle(WriteGltf("parts/gone.bin"));
  EXPECT_EQ(ReasonOf(bundle.status()), "SCENE_FILE_MISSING");
  EXPECT_NE(bundle.status().message().find("parts/gone.bin"), std::string::npos);
}

TEST_F(SceneFiles, AFolderIsNoScene) {
  EXPECT_EQ(ReasonOf(ReadSceneBundle(folder_.string()).status()), "SCENE_FILE_MISSING");
}

TEST_F(SceneFiles, NothingOutsideTheFolderIsRead) {
  Write("secret.bin", "abc");
  const std::string scene = folder_ / "parts" / "room.gltf";
  for (const std::string uri : {"../secret.bin", "x/../../secret.bin", "/etc/hostname"}) {
    std::ofstream(scene) << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":3,"uri":")"
                         << uri << R"("}]})";
    const absl::Status status = ReadSceneBundle(scene).status();
    EXPECT_EQ(ExitCodeFor(status), ExitCode::kBadScene) << uri << ": " << status;
  }
}

TEST_F(SceneFiles, BrokenJsonIsABadScene) {
  EXPECT_EQ(ExitCodeFor(ReadSceneBundle(Write("room.gltf", "{\"asset\":")).status()),
            ExitCode::kBadScene);
}

TEST_F(SceneFiles, AResultMustNotOverwriteItsScene) {
  const std::string scene = Write("room.glb", "glTF");
  const absl::Status refused = CheckSceneIsKept(scene, folder_.string() + "/parts/..");
  EXPECT_EQ(ExitCodeFor(refused), ExitCode::kUsage) << refused;
  EXPECT_TRUE(CheckSceneIsKept(scene, (folder_ / "parts").string()).ok());
}

TEST(SceneStem, NamesTheFilesOfAResult) { EXPECT_EQ(SceneStem("a/room.v2.glb"), "room.v2"); }

}  // namespace
}  // namespace lambert::app
