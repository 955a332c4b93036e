// A server that is killed, wherever and however often, loses nothing: a client that only waits for
// it gets the bytes of an undisturbed run.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <random>
#include <thread>

#include "client/channel.h"
#include "client/client.h"
#include "tests/distributed/farm.h"
#include "tests/distributed/serial_solution.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1'500'000;  // some half a second of one core

SolveOptions Wanted(uint64_t seed) {
  constexpr Method kMethods[] = {Method::kPhsHier, Method::kPmcr, Method::kPhsAlpha};
  SolveOptions options;
  options.shoot.method = kMethods[seed % 3];
  options.seed = seed;
  options.max_rays = kRays;
  return options;
}

// A farm whose server is started again whenever it dies.
class UndyingFarm {
 public:
  // `kill` is called after each start of a server, on a thread of its own.
  UndyingFarm(const ProcessOptions& environment, std::function<void(Process&)> kill)
      : farm_({"--data", folder_.path(), "--journal", "every"}, 0, environment), kill_(kill) {
    for (int i = 0; i < 2; ++i) farm_.AddWorker();
    client_ = std::make_unique<client::Client>(
        *client::Connect(farm_.address(), std::chrono::seconds(10)), client::ClientOptions());
    reviver_ = std::thread([this] { Revive(); });
  }
  ~UndyingFarm() {
    stopping_ = true;
    farm_.server().Signal(SIGKILL);
    reviver_.join();
  }

  int deaths() const { return deaths_; }

  // Solves the room as a client that only waits; returns the solution's bytes.
  std::string Solve(uint64_t seed) {
    auto scene = client_->SubmitScene(CornellBundle(), [](int64_t, int64_t) {});
    EXPECT_TRUE(scene.ok()) << scene.status();
    auto job = client_->CreateJob(scene->name, {}, Wanted(seed));
    EXPECT_TRUE(job.ok()) << job.status();
    client::WatchOptions watch;
    int64_t last_version = 0;
    watch.on_snapshot = [&](const Snapshot& snapshot) {
      EXPECT_GT(snapshot.version, last_version);
      last_version = snapshot.version;
      return absl::OkStatus();
    };
    auto ended = client_->Watch(job->name, watch);
    EXPECT_TRUE(ended.ok()) << ended.status();
    EXPECT_EQ(ended->state, client::JobState::kSucceeded) << ended->error;
    EXPECT_EQ(ended->snapshot_version, last_version);
    auto solution = client_->FetchSolution(ended->snapshot);
    EXPECT_TRUE(solution.ok()) << solution.status();
    return EncodeSolution(**solution);
  }

 private:
  void Revive() {
    while (true) {
      if (kill_) kill_(farm_.server());
      farm_.server().Wait();
      if (stopping_) return;
      ++deaths_;
      farm_.RestartServer();
    }
  }

  TemporaryFolder folder_;
  Farm farm_;
  const std::function<void(Process&)> kill_;
  std::unique_ptr<client::Client> client_;
  std::atomic<bool> stopping_{false};
  std::atomic<int> deaths_{0};
  std::thread reviver_;
};

// Where it dies, in the words of server/base/failpoint.h.
class KilledServer : public testing::TestWithParam<const char*> {};

TEST_P(KilledServer, EndsWithTheSameBytes) {
  static const std::string expected = SolveSerially(Wanted(1));
  ProcessOptions environment;
  environment.environment["LAMBERT_FAILPOINT"] = GetParam();
  UndyingFarm farm(environment, nullptr);
  EXPECT_TRUE(farm.Solve(1) == expected);
  EXPECT_EQ(farm.deaths(), 1);
}

INSTANTIATE_TEST_SUITE_P(
    Between, KilledServer,
    testing::Values("upload-before-rename:1", "upload-after-rename:1", "blob-before-rename:1",
                    "blob-before-rename:4", "blob-before-rename:12", "blob-after-rename:1",
                    "blob-after-rename:4", "blob-after-rename:12", "record-before-commit:2",
                    "record-before-commit:3", "record-before-commit:4", "record-before-commit:8",
                    "record-before-commit:14", "record-after-commit:2", "record-after-commit:3",
                    "record-after-commit:4", "record-after-commit:8", "record-after-commit:14"),
    [](const auto& info) {
      std::string name = info.param;
      for (char& c : name) c = c == '-' || c == ':' ? '_' : c;
      return name;
    });

// LAMBERT_TEST_KILLS=200 for more.
TEST(KilledServerAtRandom, EndsWithTheSameBytes) {
  const char* wanted = std::getenv("LAMBERT_TEST_KILLS");
  const int kills = wanted == nullptr ? 20 : std::atoi(wanted);
  std::mt19937 random(1);
  int left = kills;
  UndyingFarm farm({}, [&](Process& server) {
    if (left-- <= 0) return;
    std::uniform_int_distribution<int> milliseconds(0, 1500);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
    server.Signal(SIGKILL);
  });
  uint64_t seed = 0;
  while (farm.deaths() < kills) {
    ++seed;
    EXPECT_TRUE(farm.Solve(seed) == SolveSerially(Wanted(seed))) << seed;
  }
  std::printf("%d kills in %d jobs\n", farm.deaths(), static_cast<int>(seed));
}

}  // namespace
}  // namespace lambert
