// However many workers gather and whatever becomes of them and of the server, the values have the
// bytes of the loop that runs in one thread without a network.
#include <gtest/gtest.h>

#include "client/channel.h"
#include "client/client.h"
#include "radiosity/gather/gather.h"
#include "tests/distributed/farm.h"
#include "tests/distributed/serial_solution.h"

namespace lambert {
namespace {

constexpr GatherOptions kOptions{256, 5};

// A solved room and the points that are asked for.
class GatherFarm {
 public:
  explicit GatherFarm(int workers, std::vector<std::string> server_arguments = {})
      : farm_(std::move(server_arguments)) {
    for (int i = 0; i < workers; ++i) farm_.AddWorker();
    client_ = std::make_unique<client::Client>(
        *client::Connect(farm_.address(), std::chrono::seconds(10)), client::ClientOptions());
    SolveOptions solve;
    solve.shoot.method = Method::kPmcr;
    solve.max_rays = 20'000;
    auto scene = client_->SubmitScene(CornellBundle(), [](int64_t, int64_t) {});
    job_ = *client_->Watch(client_->CreateJob(scene->name, {}, solve)->name, {});
    patches_ = *client_->FetchPatches(job_.patch_set);
    for (PatchIndex i = 0; i < patches_->size(); ++i) {
      points_.Add(PatchCentroid(*patches_, i), PatchNormal(*patches_, i));
      for (const Vec3& corner : patches_->corners[i])
        points_.Add(corner, PatchNormal(*patches_, i));
    }
  }

  Farm& farm() { return farm_; }

  // What the farm gathers; `on_progress` is told of points done.
  std::string Gather(const std::function<void(size_t, size_t)>& on_progress) {
    auto gathered = client_->Gather(job_.name, points_, kOptions, on_progress);
    EXPECT_TRUE(gathered.ok()) << gathered.status();
    return gathered.ok() ? EncodeGathered(*gathered) : "";
  }
  std::string Expected() {
    auto solution = *client_->FetchSolution(job_.snapshot);
    return EncodeGathered(
        *(*GatherHere(patches_, solution->radiosity_lm_per_m2, kOptions))(points_));
  }

 private:
  Farm farm_;
  std::unique_ptr<client::Client> client_;
  client::Job job_;
  std::shared_ptr<const PatchSet> patches_;
  GatherPoints points_;
};

TEST(SameGather, WithAnyNumberOfWorkersAndOneKilled) {
  for (int workers : {1, 3}) {
    GatherFarm farm(workers);
    bool is_killed = workers == 1;
    size_t told = 0;
    const std::string gathered = farm.Gather([&](size_t done, size_t total) {
      EXPECT_GE(done, told);
      EXPECT_LE(done, total);
      told = done;
      if (is_killed || done == 0) return;
      farm.farm().worker(0).Signal(SIGKILL);
      is_killed = true;
    });
    EXPECT_EQ(gathered, farm.Expected());
    EXPECT_GT(told, 0u);
  }
}

TEST(SameGather, WithAServerThatIsKilledInTheMiddle) {
  const TemporaryFolder folder;
  GatherFarm farm(2, {"--data", folder.path()});
  bool is_killed = false;
  const std::string gathered = farm.Gather([&](size_t done, size_t total) {
    if (is_killed || done == total) return;
    is_killed = true;
    farm.farm().KillAndRestartServer();
  });
  EXPECT_TRUE(is_killed);
  EXPECT_EQ(gathered, farm.Expected());
}

}  // namespace
}  // namespace lambert
