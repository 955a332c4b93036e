// What the command says, and how it ends, when it is given what it cannot use.
#include "gtest/gtest.h"
#include "nlohmann/json.hpp"
#include "tests/app/command_fixture.h"

namespace lambert::app {
namespace {

class BadInput : public CommandFixture {
 protected:
  // Runs a command that has to fail with one line `error: WHERE: WHAT; DO THIS` and nothing else.
  std::string Fail(int exit_code, const std::vector<std::string>& arguments) {
    const Ran ran = Run(arguments);
    EXPECT_EQ(ran.exit_code, exit_code) << ran.error;
    EXPECT_EQ(ran.output, "");
    EXPECT_EQ(ran.error.find("error: "), 0u) << ran.error;
    EXPECT_EQ(ran.error.find('\n'), ran.error.size() - 1) << ran.error;
    EXPECT_NE(ran.error.find("; "), std::string::npos) << ran.error;
    return ran.error;
  }
  bool Says(const std::string& error, const std::string& part) {
    return error.find(part) != std::string::npos;
  }
};

TEST_F(BadInput, UsageErrorsEndWith2AndNameTheChoices) {
  EXPECT_TRUE(Says(Fail(2, {}), "bake, plan, submit"));
  EXPECT_TRUE(Says(Fail(2, {"backe", "room.glb"}), "did you mean lambert bake"));
  EXPECT_TRUE(Says(Fail(2, {"bake", "room.glb", "-o", "out", "--method", "x"}),
                   "auto, mcr, pmcr, hs97, hs98, phs, "));
  EXPECT_TRUE(Says(Fail(2, {"bake", "room.glb", "-o", "out", "--maxerror", "1"}), "--max-error"));
  EXPECT_TRUE(Says(Fail(2, {"bake", "room.glb"}), "-o DIR"));
  EXPECT_TRUE(Says(Fail(2, {"jobs"}), "--server HOST:PORT"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(BadInput, ASceneThatIsNotThereEndsWith3) {
  EXPECT_TRUE(Says(Fail(3, {"bake", "none.glb", "-o", "out"}), "none.glb: No such file"));
  EXPECT_TRUE(Says(Fail(3, {"plan", "none.glb"}), "none.glb"));
}

TEST_F(BadInput, ABrokenGlbEndsWith3) {
  Write("cut.glb", Read("room.glb").substr(0, 1000));
  Write("text.glb", "this is no scene");
  Write("empty.glb", "");
  for (const char* scene : {"cut.glb", "text.glb", "empty.glb"}) {
    EXPECT_TRUE(Says(Fail(3, {"bake", scene, "-o", "out", "--progress", "none"}), scene));
    EXPECT_TRUE(Says(Fail(3, {"plan", scene}), scene));
  }
}

TEST_F(BadInput, ASceneWithoutTrianglesEndsWith3) {
  Write("bare.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{}]})");
  Fail(3, {"bake", "bare.gltf", "-o", "out", "--progress", "none"});
  Fail(3, {"plan", "bare.gltf"});
}

TEST_F(BadInput, LimitsAreOptions) {
  for (const char* limit : {"--max-scene-bytes", "--max-triangles", "--max-patches"}) {
    EXPECT_TRUE(Says(Fail(3, {"plan", "room.glb", limit, "3"}), "more")) << limit;
    Fail(3, {"bake", "room.glb", limit, "3", "-o", "out", "--progress", "none"});
  }
  Fail(2, {"plan", "room.glb", "--max-image-pixels", "0"});
}

TEST_F(BadInput, AFileThatTheSceneNamesAndThatIsNotThereEndsWith3) {
  Write("parts.gltf",
        R"({"asset":{"version":"2.0"},"buffers":[{"uri":"parts.bin","byteLength":12}]})");
  EXPECT_TRUE(Says(Fail(3, {"bake", "parts.gltf", "-o", "out"}), "parts.bin: No such file"));
}

TEST_F(BadInput, WithJsonTheErrorIsAnObjectToo) {
  const Ran ran = Run({"bake", "none.glb", "-o", "out", "--json"});
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_EQ(ran.error.find("error: none.glb: "), 0u);
  const auto error = nlohmann::json::parse(ran.output)["error"];
  EXPECT_EQ(error["reason"], "SCENE_FILE_MISSING");
  EXPECT_EQ(error["where"], "none.glb");
  EXPECT_EQ(error["message"], "No such file or directory");
  EXPECT_FALSE(error["hint"].get<std::string>().empty());

  const Ran usage = Run({"bake", "room.glb", "-o", "out", "--method", "x", "--json"});
  EXPECT_EQ(nlohmann::json::parse(usage.output)["error"]["reason"], "USAGE");
}

TEST_F(BadInput, AServerThatIsNotThereEndsWith4) {
  // Port 1 of this machine: nothing listens there.
  EXPECT_TRUE(Says(Fail(4, {"bake", "room.glb", "-o", "out", "--server", "127.0.0.1:1"}),
                   "127.0.0.1:1: no server answers there"));
  Fail(4, {"jobs", "--server", "127.0.0.1:1"});
}

TEST_F(BadInput, AFolderThatCannotBeWrittenEndsWith1BeforeAnyWork) {
  Write("file", "");
  EXPECT_TRUE(Says(Fail(1, {"bake", "room.glb", "-o", "file/out"}), "file"));
}

TEST_F(BadInput, AFullDiskEndsWith1) {
  std::filesystem::create_directories(folder_ / "out");
  std::filesystem::create_symlink("/dev/full", folder_ / "out/convergence.csv");
  const std::string error =
      Fail(1, {"bake", "room.glb", "-o", "out", "--max-rays", "2000", "--progress", "none"});
  EXPECT_TRUE(Says(error, "out/convergence.csv: ") && Says(error, "No space left")) << error;
}

TEST_F(BadInput, AReferenceOfAnotherSceneEndsWith1) {
  Write("reference.csv", "patch,node\n0,0\n");
  Fail(1, {"bake", "room.glb", "-o", "out", "--reference", "reference.csv"});
  Fail(1, {"bake", "room.glb", "-o", "out", "--reference", "none.csv"});
}

TEST_F(BadInput, ASceneWithoutEmittersIsSolvedAllDarkWithAWarning) {
  Write("dark.glb", ToGlb(MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6))));
  const Ran ran = Run({"bake", "dark.glb", "-o", "out", "--progress", "none"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  EXPECT_NE(ran.error.find("warning: "), std::string::npos);
  ExpectAllFiles("out", "dark");
}

}  // namespace
}  // namespace lambert::app
