// `lambert bench` as a user runs it.
#include <algorithm>
#include <csignal>

#include "gtest/gtest.h"
#include "nlohmann/json.hpp"
#include "tests/app/command_fixture.h"

namespace lambert::app {
namespace {

using Json = nlohmann::json;

class BenchTest : public CommandFixture {
 protected:
  Ran Bench(std::vector<std::string> more) {
    more.insert(more.begin(), {"bench", "--progress", "none"});
    return Run(more);
  }
};

TEST_F(BenchTest, TwoMethodsTwoSeedsTwoBudgetsLeaveEveryFile) {
  const Ran ran = Bench({"room.glb", "-o", "deep/out", "--methods", "pmcr,phs:depth=1", "--seeds",
                         "2", "--budgets", "5k,20k", "--region", "0"});
  ASSERT_EQ(ran.exit_code, 0) << ran.error;
  EXPECT_EQ(ran.error, "");
  EXPECT_NE(ran.output.find("phs:depth=1"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("residual"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("mean z2"), std::string::npos) << ran.output;
  for (const char* file : {"reference.csv", "summary.csv", "convergence.csv", "run.json",
                           "pictures/methods.png", "pictures/phs_depth_1_detail.png"}) {
    EXPECT_GT(Read(std::string("deep/out/") + file).size(), 100u) << file;
  }
  for (const char* figure : {"error_rays", "error_time", "figure9", "figure10", "costs"}) {
    for (const char* ending : {".png", ".svg", ".gp"}) {
      const std::string file = std::string("deep/out/figures/") + figure + ending;
      EXPECT_GT(Read(file).size(), 100u) << file;
    }
  }
  const std::string summary = Read("deep/out/summary.csv");
  EXPECT_EQ(std::count(summary.begin(), summary.end(), '\n'), 1 + 2 * 2) << summary;
  EXPECT_NE(summary.find("\nphs:depth=1,20000,2,"), std::string::npos) << summary;
  for (const Json& line : Json::parse(Read("deep/out/run.json"))["summary"]) {
    // Two seeds hit only some patches often enough.
    if (line["z2_patches"].is_null()) continue;
    EXPECT_GT(line["mean_z2"], 0);
    EXPECT_GT(line["null_z2_sd"], 0);
  }
  const std::string convergence = Read("deep/out/convergence.csv");
  EXPECT_EQ(convergence.find("method,seed,pass,step,rays,"), 0u);
  EXPECT_NE(convergence.find("\nphs:depth=1,2,"), std::string::npos);
  EXPECT_GE(std::count(convergence.begin(), convergence.end(), '\n'), 1 + 8);
}

TEST_F(BenchTest, AReferenceThatWasMadeIsReadTheNextTime) {
  ASSERT_EQ(Bench({"room.glb", "-o", "one", "--methods", "pmcr", "--seeds", "1", "--budgets", "5k",
                   "--reference-rays", "200k"})
                .exit_code,
            0);
  const Ran ran = Bench({"room.glb", "-o", "two", "--methods", "pmcr", "--seeds", "1", "--budgets",
                         "5k", "--reference", "one/reference.csv", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.error;
  const Json scene = Json::parse(ran.output)["scenes"][0];
  EXPECT_EQ(scene["reference"]["file"], "one/reference.csv");
  EXPECT_GT(scene["reference"]["residual"]["rms_area"], 0);
  EXPECT_EQ(Read("two/reference.csv"), "");
  // The same seed against the same reference.
  const Json first = Json::parse(Read("one/run.json"))["summary"][0];
  EXPECT_EQ(scene["summary"][0]["rms_area"], first["rms_area"]);
  EXPECT_EQ(Json::parse(Read("two/run.json"))["summary"][0]["rms_area"], first["rms_area"]);
}

TEST_F(BenchTest, AReferenceIsMadeToAResidual) {
  const Ran ran = Bench({"room.glb", "-o", "out", "--methods", "pmcr", "--seeds", "1", "--budgets",
                         "5k", "--reference-error", "0.05", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.error;
  const Json residual = Json::parse(ran.output)["scenes"][0]["reference"]["residual"];
  EXPECT_GT(residual["rms_area"], 0);
  EXPECT_LT(residual["rms_area"], 0.08);
}

TEST_F(BenchTest, SeveralScenesGetAFolderEachAndABudgetMayBeTime) {
  Write("box.glb", ToGlb(MakeFurnace(0.5)));
  const Ran ran = Bench({"room.glb", "box.glb", "-o", "out", "--methods", "pmcr", "--seeds", "1",
                         "--budgets", "0.05s", "--reference-rays", "20k", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.error;
  const Json scenes = Json::parse(ran.output)["scenes"];
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(scenes[1]["folder"], "out/box");
  EXPECT_EQ(scenes[0]["summary"][0]["budget"], "0.05s");
  EXPECT_GT(Read("out/room/summary.csv").size(), 0u);
  EXPECT_GT(Read("out/box/figures/error_time.svg").size(), 0u);
}

TEST_F(BenchTest, MistakesAreUsageErrorsThatNameTheChoices) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> mistakes = {
      {{"--methods", "radiance"}, "choose one of auto, mcr, pmcr"},
      {{"--methods", "phs:dept=1"}, "choose one of allocation, alpha1, alpha2"},
      {{"--budgets", "soon"}, "neither rays (200k) nor seconds (1.5s)"},
      {{"--region", "nowhere"}, "one of its nodes: 0"},
      {{"--budgts", "2"}, "did you mean --budgets"},
      {{"--method", "phs"}, "did you mean --methods"}};
  for (const auto& [arguments, answer] : mistakes) {
    std::vector<std::string> line = {"room.glb", "-o", "out"};
    line.insert(line.end(), arguments.begin(), arguments.end());
    const Ran ran = Bench(line);
    EXPECT_EQ(ran.exit_code, 2) << ran.error;
    EXPECT_NE(ran.error.find(answer), std::string::npos) << ran.error;
  }
  EXPECT_EQ(Bench({"-o", "out"}).exit_code, 2);
  EXPECT_EQ(Bench({"room.glb"}).exit_code, 2);
}

TEST_F(BenchTest, AReferenceOfOtherPatchesIsRefusedBeforeAnyRun) {
  ASSERT_EQ(
      Run({"bake", "room.glb", "-o", "other", "--max-rays", "2000", "--max-edge", "0.3"}).exit_code,
      0);
  const Ran ran = Bench({"room.glb", "-o", "out", "--reference", "other/patches.csv"});
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.error.find("have no partner"), std::string::npos) << ran.error;
}

TEST_F(BenchTest, CtrlCKeepsTheRunsThatAreDone) {
  const auto bench =
      Start({"bench", "room.glb", "-o", "out", "--methods", "pmcr", "--seeds", "1", "--budgets",
             "5k,1G", "--reference-rays", "20k", "--progress", "plain"});
  ASSERT_NE(bench->WaitForError("run 2 of 2"), std::string::npos) << bench->error();
  bench->Signal(SIGINT);
  EXPECT_EQ(bench->Wait(), 130) << bench->error();
  const Json run = Json::parse(Read("out/run.json"));
  EXPECT_TRUE(run["interrupted"]);
  EXPECT_EQ(run["summary"].size(), 1u);
  EXPECT_GT(Read("out/figures/error_rays.svg").size(), 0u);
}

}  // namespace
}  // namespace lambert::app
