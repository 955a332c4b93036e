#include "radiosity/output/write_outputs.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "radiosity/core/error.h"
#include "radiosity/output/output_file.h"
#include "tests/output/known_light.h"
#include "tests/support/read_file.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

RunRecord SomeRecord() {
  return RecordOf(PatchesOf(MakeCornell()), [](Vec3 p) { return Rgb{1, 1 + p.y, 1}; });
}

std::set<std::string> FilesIn(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

TEST(WriteOutputs, LeavesTheAgreedFilesAndNothingElse) {
  const std::string folder = TestFolder() + "/new/out";
  const absl::Status status = WriteOutputs(folder, SomeRecord());
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_EQ(FilesIn(folder), (std::set<std::string>{"patches.csv", "run.json", "room.glb",
                                                    "room.exr", "room.png", "report.html"}));
}

TEST(WriteOutputs, LeavesOutWhatIsNotAskedForAndTheRestIsTheSame) {
  const std::string all = TestFolder() + "/all";
  ASSERT_TRUE(WriteOutputs(all, SomeRecord()).ok());
  const std::pair<OutputFiles, std::string> cases[] = {
      {{true, false, false, false, false}, "patches.csv"},
      {{false, true, false, false, false}, "room.glb"},
      {{false, false, true, false, false}, "room.exr"},
      {{false, false, false, true, false}, "room.png"},
      {{false, false, false, false, true}, "report.html"}};
  for (const auto& [files, name] : cases) {
    const std::string folder = TestFolder() + "/" + name + ".d";
    ASSERT_TRUE(WriteOutputs(folder, SomeRecord(), files).ok());
    EXPECT_EQ(FilesIn(folder), (std::set<std::string>{name, "run.json"}));
    EXPECT_EQ(ReadFile(folder + "/" + name), ReadFile(all + "/" + name));
  }
  const std::string none = TestFolder() + "/none";
  ASSERT_TRUE(WriteOutputs(none, SomeRecord(), {false, false, false, false, false}).ok());
  EXPECT_EQ(FilesIn(none), std::set<std::string>{"run.json"});
}

TEST(WriteOutputs, EqualRecordsGiveEqualBytes) {
  const std::string a = TestFolder() + "/a", b = TestFolder() + "/b";
  ASSERT_TRUE(WriteOutputs(b, SomeRecord()).ok());
  ASSERT_TRUE(WriteOutputs(a, SomeRecord()).ok());
  for (const std::string& name : FilesIn(a)) {
    EXPECT_EQ(ReadFile(a + "/" + name), ReadFile(b + "/" + name)) << name;
  }
}

TEST(WriteOutputs, ASceneWithoutLightHasAllFilesToo) {
  const std::string folder = TestFolder();
  const RunRecord record = RecordOf(PatchesOf(MakeFurnace(0.5, 0)), [](Vec3) { return Rgb{}; });
  ASSERT_TRUE(WriteOutputs(folder, record).ok());
  EXPECT_EQ(FilesIn(folder).size(), 6u);
}

TEST(WriteOutputs, AFolderThatCannotBeMadeIsNamed) {
  const std::string file = TestFolder() + "/file";
  ASSERT_TRUE(WriteOutputFile(file, "x").ok());
  const absl::Status status = WriteOutputs(file + "/out", SomeRecord());
  EXPECT_EQ(ReasonOf(status), "OUTPUT_FAILED");
}

}  // namespace
}  // namespace lambert
