// `lambert bake` in one process, as a user runs it.
#include <csignal>

#include "gtest/gtest.h"
#include "nlohmann/json.hpp"
#include "tests/app/command_fixture.h"

namespace lambert::app {
namespace {

using Json = nlohmann::json;

class BakeTest : public CommandFixture {};

TEST_F(BakeTest, LeavesEveryFileAndSaysWhereTheyAre) {
  const Ran ran = Run({"bake", "room.glb", "-o", "deep/out", "--max-rays", "20000"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  ExpectAllFiles("deep/out");
  EXPECT_NE(ran.output.find("deep/out/room.glb"), std::string::npos) << ran.output;
  EXPECT_NE(ran.error.find("rays"), std::string::npos) << ran.error;
}

TEST_F(BakeTest, TheSameSeedGivesTheSameBytesWithAnyWorkersAndThreads) {
  const std::vector<std::string> base = {"bake",  "room.glb",   "--max-rays",
                                         "20000", "--progress", "none"};
  const auto bake = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = base;
    arguments.insert(arguments.end(), {"-o", out});
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(Run(arguments).exit_code, 0);
    return Read(out + "/patches.csv");
  };
  const std::string one = bake("one", {"--workers", "1", "--threads", "1"});
  EXPECT_EQ(one, bake("two", {"--workers", "2", "--threads", "1"}));
  EXPECT_EQ(one, bake("three", {"--workers", "1", "--threads", "3"}));
  EXPECT_NE(one, bake("other", {"--seed", "2"}));
}

TEST_F(BakeTest, AFinalGatherAndSensorsAreTheSameBytesWithAnyWorkers) {
  Write("points.csv", "x,y,z\n0.5,0.5,0.5\n");
  const auto bake = [&](const std::string& out, const std::string& workers) {
    const Ran ran = Run({"bake", "room.glb", "-o", out, "--max-rays", "20000", "--final-gather",
                         "4", "--work-plane", "0.7", "--sensors", "points.csv", "--workers",
                         workers, "--threads", "1"});
    EXPECT_EQ(ran.exit_code, 0) << ran.error;
    EXPECT_NE(ran.output.find("sensors.json"), std::string::npos) << ran.output;
    return Read(out + "/sensors.csv") + Read(out + "/room.glb") + Read(out + "/room.png");
  };
  EXPECT_EQ(bake("one", "1"), bake("three", "3"));
  EXPECT_EQ(Json::parse(Read("one/run.json"))["final_gather_rays"], 4);
  const Json grids = Json::parse(Read("one/sensors.json"))["grids"];
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0]["sensors"], 1);
  EXPECT_GT(grids[1]["mean"], 0);
  EXPECT_NE(Read("one/report.html").find("<h2>Sensors</h2>"), std::string::npos);
}

TEST_F(BakeTest, SensorsThatCannotBeReadAreToldBeforeAnyWork) {
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--sensors", "none.csv"});
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.error.find("error: none.csv: "), std::string::npos) << ran.error;
}

TEST_F(BakeTest, WithJsonStandardOutputIsOneObject) {
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--max-error", "0.2", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  const Json summary = Json::parse(ran.output);
  EXPECT_EQ(summary["state"], "succeeded");
  EXPECT_EQ(summary["stop_reason"], "error_reached");
  EXPECT_TRUE(summary["reached_goal"]);
  EXPECT_LE(summary["estimated_rms_area"], 0.2);
  EXPECT_EQ(summary["files"].size(), 7u);
}

TEST_F(BakeTest, ALightmapIsWrittenWhereItIsAskedFor) {
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--max-rays", "20000", "--lightmap",
                       "--texels-per-meter", "9", "--lightmap-page", "256"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  for (const char* file : {"lightmapped.glb", "lit.glb", "irradiance.exr", "lightmap.json"}) {
    EXPECT_NE(ran.output.find(std::string("out/room.") + file), std::string::npos) << ran.output;
  }
  EXPECT_EQ(Json::parse(Read("out/room.lightmap.json"))["texels_per_meter"], 9);
  const Ran without =
      Run({"bake", "room.glb", "-o", "plain", "--max-rays", "20000", "--texels-per-meter", "9"});
  EXPECT_NE(without.error.find("--texels-per-meter has no effect"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plain/room.lightmapped.glb"));
}

TEST_F(BakeTest, ABudgetSpentBeforeTheWantedErrorEndsWith5AndKeepsTheResult) {
  const Ran ran = Run(
      {"bake", "room.glb", "-o", "out", "--max-error", "1e-6", "--max-rays", "20000", "--json"});
  EXPECT_EQ(ran.exit_code, 5) << ran.error;
  EXPECT_EQ(Json::parse(ran.output)["stop_reason"], "rays_spent");
  ExpectAllFiles("out");
}

TEST_F(BakeTest, ATimeBudgetEndsTheRun) {
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--max-time", "0.3", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  EXPECT_EQ(Json::parse(ran.output)["stop_reason"], "time_spent");
}

TEST_F(BakeTest, CtrlCKeepsTheBestSoFar) {
  const auto bake = Start({"bake", "room.glb", "-o", "out", "--max-error", "1e-9", "--json"});
  ASSERT_NE(bake->WaitForError("error "), std::string::npos) << bake->error();
  bake->Signal(SIGINT);
  EXPECT_EQ(bake->Wait(), 130) << bake->error();
  const Json summary = Json::parse(bake->output());
  EXPECT_EQ(summary["state"], "cancelled");
  EXPECT_TRUE(summary["interrupted"]);
  EXPECT_GT(summary["rays"], 0);
  ExpectAllFiles("out");
}

TEST_F(BakeTest, ConvergenceIsWrittenAsTheRunGoes) {
  const auto bake = Start({"bake", "room.glb", "-o", "out", "--max-error", "1e-9"});
  // The first snapshot is told of, then logged; the second line of progress after it comes later.
  size_t at = bake->WaitForError("patches, method");
  for (int line = 0; line < 2; ++line) at = bake->WaitForError("rays/s", at);
  ASSERT_NE(at, std::string::npos) << bake->error();
  const std::string table = Read("out/convergence.csv");
  EXPECT_EQ(table.find("method,seed,pass,step,rays,"), 0u);
  EXPECT_GT(std::count(table.begin(), table.end(), '\n'), 1);
  bake->Signal(SIGINT);
  bake->Wait();
}

TEST_F(BakeTest, AReferenceFillsTheMeasuredColumnsAndCompareAgrees) {
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "reference", "--max-rays", "400000"}).exit_code, 0);
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--max-rays", "20000", "--seed", "7",
                       "--reference", "reference/patches.csv", "--region", "0", "--json"});
  ASSERT_EQ(ran.exit_code, 0) << ran.error;
  const Json measures = Json::parse(ran.output)["measures"];
  const Ran compared =
      Run({"compare", "out/patches.csv", "reference/patches.csv", "--region", "0", "--json"});
  EXPECT_EQ(compared.exit_code, 0) << compared.error;
  EXPECT_EQ(Json::parse(compared.output), measures);
  EXPECT_GT(measures["rms_area"], 0);
  EXPECT_GT(measures["rms_local"], 0);
  const std::string table = Read("out/convergence.csv");
  EXPECT_EQ(table.find(",,"), std::string::npos) << table;
}

TEST_F(BakeTest, AnUnknownRegionIsAUsageError) {
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "reference", "--max-rays", "2000"}).exit_code, 0);
  const Ran ran = Run({"bake", "room.glb", "-o", "out", "--reference", "reference/patches.csv",
                       "--region", "nowhere", "--progress", "none"});
  EXPECT_EQ(ran.exit_code, 2);
  EXPECT_NE(ran.error.find("error: --region: the scene has no node 'nowhere'"), std::string::npos);
}

TEST_F(BakeTest, ATableComparedWithItselfIsWithoutError) {
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "out", "--max-rays", "20000"}).exit_code, 0);
  const Ran ran = Run({"compare", "out/patches.csv", "out/patches.csv", "--json"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_EQ(Json::parse(ran.output)["rms_area"], 0);
  EXPECT_EQ(Json::parse(ran.output)["power_bias"], 0);
}

TEST_F(BakeTest, PlanSolvesNothingAndNamesTheMethod) {
  const Ran ran = Run({"plan", "room.glb", "--json"});
  EXPECT_EQ(ran.exit_code, 0) << ran.error;
  const Json plan = Json::parse(ran.output);
  EXPECT_EQ(plan["patches"], 128);
  EXPECT_NE(plan["method"], "auto");
  EXPECT_GT(plan["max_error"], 0);
  EXPECT_FALSE(plan["items"].empty());
  EXPECT_EQ(Run({"plan", "room.glb"}).exit_code, 0);
}

TEST_F(BakeTest, AFlagWinsOverTheEnvironmentAndThatOverLambertToml) {
  const auto seed = [this](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"plan", "room.glb", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Json::parse(Run(arguments).output)["seed"].get<int>();
  };
  Write("lambert.toml", "seed = 3\n");
  EXPECT_EQ(seed({}), 3);
  environment_["LAMBERT_SEED"] = "2";
  EXPECT_EQ(seed({}), 2);
  EXPECT_EQ(seed({"--seed", "1"}), 1);
}

TEST_F(BakeTest, ProgressGoesToStandardErrorInTheFormThatIsWanted) {
  const auto error = [this](const std::string& mode) {
    return Run({"bake", "room.glb", "-o", "out", "--max-rays", "20000", "--progress", mode}).error;
  };
  EXPECT_EQ(error("none"), "");
  // Redrawn in place; 80 columns have no room for the bar itself beside its words.
  EXPECT_NE(error("bar").find("\r\033[K"), std::string::npos);
  const std::string lines = error("json");
  const std::string last = lines.substr(lines.rfind('\n', lines.size() - 2) + 1);
  EXPECT_GT(Json::parse(last)["progress"]["rays"], 0);
}

}  // namespace
}  // namespace lambert::app
