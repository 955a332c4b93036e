// The command as a client of servers and workers that are processes of their own.
#include <cmath>
#include <csignal>

#include "gtest/gtest.h"
#include "nlohmann/json.hpp"
#include "tests/app/command_fixture.h"

namespace lambert::app {
namespace {

using Json = nlohmann::json;

class ServerTest : public CommandFixture {
 protected:
  // Starts a server that keeps its jobs in the folder `data`, on `address`.
  void StartServer(const std::string& address = "127.0.0.1:0") {
    server_ = std::make_unique<Process>(
        std::vector<std::string>{LAMBERT_SERVER, "--listen", address, "--data", "data"}, Here());
    const std::string announcement = "listening on ";
    size_t begin = server_->WaitForError(announcement);
    ASSERT_NE(begin, std::string::npos) << server_->error();
    server_->WaitForError("\n", begin);
    const std::string log = server_->error();
    address_ = log.substr(begin, log.find_first_of(" \n", begin) - begin);
  }
  void StartWorker() {
    worker_ = std::make_unique<Process>(
        std::vector<std::string>{LAMBERT_WORKER, "--server", address_}, Here());
  }
  // With --server behind the other arguments.
  std::vector<std::string> There(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"--server", address_});
    return arguments;
  }

  std::string address_;
  std::unique_ptr<Process> server_, worker_;
};

TEST_F(ServerTest, AFarmGivesTheBytesThatOneProcessGives) {
  StartServer();
  StartWorker();
  const Ran there = Run(There({"bake", "room.glb", "-o", "there", "--max-rays", "20000"}));
  EXPECT_EQ(there.exit_code, 0) << there.error;
  ExpectAllFiles("there");
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "here", "--max-rays", "20000"}).exit_code, 0);
  EXPECT_EQ(Read("here/patches.csv"), Read("there/patches.csv"));
  EXPECT_EQ(Json::parse(Run({"plan", "room.glb", "--json"}).output),
            Json::parse(Run(There({"plan", "room.glb", "--json"})).output));
}

// A spot and a directional light of the file, a lamp, a sky and the sun, shot and gathered by two.
TEST_F(ServerTest, EveryKindOfLightIsTheSameBytesFromAFarm) {
  Scene scene = MakeCornell(2);
  const double half = std::sqrt(0.5);
  Light spot{"spot", {1, 1.5, 1}, {40, 40, 30}};
  spot.y = {0, 0, 1}, spot.z = {0, -1, 0};
  spot.cos_inner = 0.9, spot.cos_outer = 0.5;
  Light distant{"noon", {}, {90, 100, 100}, Light::Kind::kDistant};
  distant.y = {0, half, half}, distant.z = {0, -half, half};
  scene.lights = {spot, distant, {"lamp", {1.5, 1.8, 1}, {1, 1, 1}}};
  Write("lights.glb", ToGlb(scene));
  Write("lamp.ies",
        "IESNA:LM-63-2002\n[TEST] none\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n"
        "0 60 180\n0\n90 40 0\n");
  const std::vector<std::string> bake = {"bake",
                                         "lights.glb",
                                         "--max-rays",
                                         "20000",
                                         "--sky",
                                         "overcast",
                                         "--sun",
                                         "150,40,9000",
                                         "--ies",
                                         "lamp.ies=lamp",
                                         "--final-gather",
                                         "4",
                                         "--work-plane",
                                         "0.7",
                                         "--lightmap",
                                         "--texels-per-meter",
                                         "4"};
  const auto into = [&](const std::string& folder) {
    std::vector<std::string> arguments = bake;
    arguments.insert(arguments.end(), {"-o", folder});
    return arguments;
  };
  StartServer();
  StartWorker();
  const Process second({LAMBERT_WORKER, "--server", address_}, Here());
  const Ran there = Run(There(into("there")));
  ASSERT_EQ(there.exit_code, 0) << there.error;
  const Ran here = Run(into("here"));
  ASSERT_EQ(here.exit_code, 0) << here.error;
  for (const char* file : {"patches.csv", "sensors.csv", "lights.glb", "lights.png",
                           "lights.lit.glb", "lights.lightmapped.glb", "lights.irradiance.exr"}) {
    EXPECT_GT(Read(std::string("here/") + file).size(), 100u) << file;
    EXPECT_EQ(Read(std::string("here/") + file), Read(std::string("there/") + file)) << file;
  }
}

// A file in centimetres with glass in it.
TEST_F(ServerTest, UnitsOfLengthAndBlendReachTheServer) {
  Scene scene = MakeCornell(2);
  scene.materials.back().blend = true;
  Write("room.glb", ToGlb(scene));
  StartServer();
  StartWorker();
  const auto bake = [&](const std::string& folder, std::vector<std::string> more) {
    more.insert(more.begin(), {"bake", "room.glb", "-o", folder, "--max-rays", "20000"});
    const Ran ran = Run(more);
    EXPECT_EQ(ran.exit_code, 0) << ran.error;
    return Json::parse(Read(folder + "/run.json"))["totals"];
  };
  const Json plain = bake("plain", {});
  const std::vector<std::string> options = {"--scene-unit", "cm", "--blend", "omit"};
  const Json here = bake("here", options), there = bake("there", There(options));
  EXPECT_EQ(Read("here/patches.csv"), Read("there/patches.csv"));
  EXPECT_LT(there["patches"], plain["patches"]) << "what is BLEND is left out";
  const double area = bake("cm", There({"--scene-unit", "cm"}))["area_m2"];
  EXPECT_NEAR(area, plain["area_m2"].get<double>() * 1e-4, 1e-12);
}

TEST_F(ServerTest, AJobIsSubmittedWatchedFetchedListedAndDeleted) {
  StartServer();
  StartWorker();
  const Ran submitted = Run(There({"submit", "room.glb", "--max-rays", "20000"}));
  ASSERT_EQ(submitted.exit_code, 0) << submitted.error;
  const std::string job = submitted.output.substr(0, submitted.output.find('\n'));
  EXPECT_EQ(job.find("solveJobs/"), 0u);
  EXPECT_EQ(submitted.output, job + "\n");

  const Ran watched = Run(There({"watch", job, "--json"}));
  EXPECT_EQ(watched.exit_code, 0) << watched.error;
  EXPECT_EQ(Json::parse(watched.output)["state"], "succeeded");

  EXPECT_EQ(Run(There({"fetch", job, "-o", "out", "--final-gather", "4", "--work-plane", "0.7"}))
                .exit_code,
            0);
  ExpectAllFiles("out");

  const Json jobs = Json::parse(Run(There({"jobs", "--json"})).output);
  ASSERT_EQ(jobs.size(), 1u);
  EXPECT_EQ(jobs[0]["job"], job);
  EXPECT_EQ(jobs[0]["scene"], "room.glb");
  const Json workers = Json::parse(Run(There({"workers", "--json"})).output);
  ASSERT_EQ(workers.size(), 1u);
  EXPECT_GT(workers[0]["finished_units"], 0);

  EXPECT_EQ(Run(There({"delete", job})).exit_code, 0);
  EXPECT_EQ(Json::parse(Run(There({"jobs", "--json"})).output).size(), 0u);
  const Ran gone = Run(There({"fetch", job, "-o", "out"}));
  EXPECT_EQ(gone.exit_code, 1);
  EXPECT_NE(gone.error.find(job), std::string::npos) << gone.error;
}

TEST_F(ServerTest, ACancelledJobKeepsItsResult) {
  StartServer();
  StartWorker();
  std::string job = Run(There({"submit", "room.glb", "--max-error", "1e-9"})).output;
  job.pop_back();
  const auto watch = Start(There({"watch", job}));
  ASSERT_NE(watch->WaitForError("error "), std::string::npos) << watch->error();
  EXPECT_EQ(Run(There({"cancel", job})).exit_code, 0);
  EXPECT_EQ(watch->Wait(), 130) << watch->error();
  EXPECT_EQ(Run(There({"fetch", job, "-o", "out"})).exit_code, 0);
  ExpectAllFiles("out");
}

TEST_F(ServerTest, ListsAreKeptUpToDateUntilCtrlC) {
  StartServer();
  const std::string lambert = std::string("exec ") + LAMBERT_COMMAND;
  const auto watch = [&](const std::string& list) {
    const std::string command = lambert + " " + list + " --watch --server " + address_ + " >&2";
    return std::make_unique<Process>(std::vector<std::string>{"/bin/sh", "-c", command}, Here());
  };
  const auto jobs = watch("jobs"), workers = watch("workers --json");
  std::string job = Run(There({"submit", "room.glb", "--max-rays", "20000"})).output;
  job.pop_back();
  EXPECT_NE(jobs->WaitForError(job), std::string::npos) << jobs->error();
  EXPECT_NE(workers->WaitForError("[]"), std::string::npos) << workers->error();
  StartWorker();
  EXPECT_NE(workers->WaitForError("\"slots\": 1"), std::string::npos) << workers->error();
  EXPECT_NE(jobs->WaitForError("succeeded"), std::string::npos) << jobs->error();
  EXPECT_EQ(jobs->error().find('\x1b'), std::string::npos);  // no terminal, no escapes
  jobs->Signal(SIGINT);
  EXPECT_EQ(jobs->Wait(), 130);
  workers->Signal(SIGINT);
  EXPECT_EQ(workers->Wait(), 130);
}

TEST_F(ServerTest, OnATerminalAListIsDrawnInPlaceOnAScreenOfItsOwn) {
  StartServer();
  const std::string jobs = std::string(LAMBERT_COMMAND) + " workers --watch --server " + address_;
  Process terminal({"/bin/sh", "-c", "exec script -qec '" + jobs + "' /dev/null >&2"}, Here());
  EXPECT_NE(terminal.WaitForError("\x1b[?1049h"), std::string::npos);
  EXPECT_NE(terminal.WaitForError("WORKER"), std::string::npos);
  const size_t drawn = terminal.error().size();
  EXPECT_NE(terminal.WaitForError("\x1b[H", drawn), std::string::npos);  // once more
}

TEST_F(ServerTest, AJobWithoutWorkersSaysSoAndGoesOnOnceOneComes) {
  StartServer();
  const auto bake = Start(There({"bake", "room.glb", "-o", "out", "--max-rays", "20000"}));
  ASSERT_NE(bake->WaitForError("start one with: lambert-worker --server " + address_),
            std::string::npos)
      << bake->error();
  StartWorker();
  EXPECT_EQ(bake->Wait(), 0) << bake->error();
}

TEST_F(ServerTest, CtrlCInWatchLeavesTheJobAlone) {
  StartServer();
  StartWorker();
  std::string job = Run(There({"submit", "room.glb", "--max-error", "1e-9"})).output;
  job.pop_back();
  const auto watch = Start(There({"watch", job}));
  ASSERT_NE(watch->WaitForError("rays"), std::string::npos) << watch->error();
  watch->Signal(SIGINT);
  EXPECT_EQ(watch->Wait(), 130) << watch->error();
  EXPECT_EQ(Json::parse(Run(There({"jobs", "--json"})).output)[0]["state"], "running");
}

TEST_F(ServerTest, AServerThatIsKilledAndStartedAgainIsGoneOnWith) {
  StartServer();
  StartWorker();
  const auto bake =
      Start(There({"bake", "room.glb", "-o", "out", "--max-rays", "20M", "--progress", "plain"}));
  ASSERT_NE(bake->WaitForError("error "), std::string::npos) << bake->error();
  server_->Signal(SIGKILL);
  server_->Wait();
  ASSERT_NE(bake->WaitForError("lost " + address_), std::string::npos) << bake->error();
  StartServer(address_);
  EXPECT_EQ(bake->Wait(), 0) << bake->error();
  EXPECT_NE(bake->error().find("back at " + address_), std::string::npos) << bake->error();
  ExpectAllFiles("out");
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "here", "--max-rays", "20M"}).exit_code, 0);
  EXPECT_EQ(Read("here/patches.csv"), Read("out/patches.csv"));
}

TEST_F(ServerTest, AClientThatIsKilledLeavesItsJobToWhoeverComes) {
  StartServer();
  StartWorker();
  const auto bake =
      Start(There({"bake", "room.glb", "-o", "out", "--max-rays", "20M", "--progress", "plain"}));
  ASSERT_NE(bake->WaitForError("error "), std::string::npos) << bake->error();
  bake->Signal(SIGKILL);
  bake->Wait();
  const std::string job = Json::parse(Run(There({"jobs", "--json"})).output)[0]["job"];
  EXPECT_EQ(Run(There({"watch", job})).exit_code, 0);
  EXPECT_EQ(Run(There({"fetch", job, "-o", "out"})).exit_code, 0);
  ASSERT_EQ(Run({"bake", "room.glb", "-o", "here", "--max-rays", "20M"}).exit_code, 0);
  EXPECT_EQ(Read("here/patches.csv"), Read("out/patches.csv"));
}

TEST_F(ServerTest, AServerThatStaysAwayEndsWith4AndSaysHowToGoOn) {
  StartServer();
  StartWorker();
  const auto bake =
      Start(There({"bake", "room.glb", "-o", "out", "--max-error", "1e-9", "--reconnect", "0.5"}));
  ASSERT_NE(bake->WaitForError("error "), std::string::npos) << bake->error();
  server_->Signal(SIGKILL);
  EXPECT_EQ(bake->Wait(), 4) << bake->error();
  EXPECT_NE(bake->error().find("lambert watch solveJobs/"), std::string::npos) << bake->error();
}

TEST_F(ServerTest, CtrlCTwiceLeavesAtOnceAlsoWhenTheServerIsFrozen) {
  StartServer();
  StartWorker();
  const auto bake = Start(There({"bake", "room.glb", "-o", "out", "--max-error", "1e-9"}));
  ASSERT_NE(bake->WaitForError("error "), std::string::npos) << bake->error();
  server_->Signal(SIGSTOP);
  bake->Signal(SIGINT);
  ASSERT_NE(bake->WaitForError("stopping"), std::string::npos) << bake->error();
  bake->Signal(SIGINT);
  EXPECT_EQ(bake->Wait(), 130) << bake->error();
}

}  // namespace
}  // namespace lambert::app
