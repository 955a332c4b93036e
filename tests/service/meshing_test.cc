// Jobs whose patches are split where light needs it.
#include <gtest/gtest.h>

#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/solver.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1'000'000, kPatches = 3000;

// What a job on MakeCornell(1) is without a network.
struct Serial {
  std::shared_ptr<const PatchSet> patches;
  Meshing meshing;
  std::string solution;
  std::vector<std::string> pilots;  // their solutions
};

Solution Solve(const std::shared_ptr<const PatchSet>& patches, const SolveOptions& options,
               bool adapted, int64_t* rays) {
  const Plan plan = MakePlan(*patches, options, adapted);
  SerialExecutor executor(*Shooter::Create(patches, plan.options.shoot));
  Solver solver(patches, plan.options, [] { return 0.0; });
  while (solver.stop_reason() == StopReason::kNone) {
    EXPECT_TRUE(solver.RunPass(executor, nullptr).ok());
  }
  *rays += solver.MakeSnapshot().progress.rays;
  return *solver.MakeSnapshot().solution;
}

Serial SolveSerially() {
  const Scene scene = *LoadGltf({"room.glb", ToGlb(MakeCornell(1)), {}});
  PatchOptions patch;
  patch.adapt_patches = kPatches;
  SolveOptions options;
  options.shoot.method = Method::kAuto;
  options.max_rays = kRays;
  Serial serial;
  serial.patches = *AdaptMesh(
      scene, patch, options,
      [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
          int32_t) -> absl::StatusOr<Solution> {
        Solution solution = Solve(patches, pilot, false, &serial.meshing.pilot_rays);
        serial.pilots.push_back(EncodeSolution(solution));
        return solution;
      },
      &serial.meshing);
  int64_t rays = 0;
  serial.solution = EncodeSolution(Solve(serial.patches, options, true, &rays));
  return serial;
}

class MeshingJob : public ServiceFixture {
 protected:
  v1::SolveJob CreateAdaptedJob() {
    v1::Scene scene;
    EXPECT_TRUE(CreateScene(ToGlb(MakeCornell(1)), &scene).ok());
    v1::CreateSolveJobRequest request;
    request.set_scene(scene.name());
    request.mutable_spec()->set_max_ray_count(kRays);
    request.mutable_spec()->mutable_patch()->set_adapt_patch_count(kPatches);
    v1::SolveJob job;
    grpc::ClientContext context;
    EXPECT_TRUE(jobs()->CreateSolveJob(&context, request, &job).ok());
    return job;
  }
};

TEST_F(MeshingJob, GivesTheBytesOfTheLoopWithoutANetworkAndTellsWhatItDid) {
  const Serial serial = SolveSerially();
  ASSERT_GT(serial.patches->size(), 64);
  ASSERT_GT(serial.pilots.size(), 1u);
  AddWorker();
  AddWorker();
  const Watched watched = Watch(CreateAdaptedJob().name());
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(watched.ended.patch_set_digest().sha256(),
            DigestOf(EncodePatchSet(*serial.patches)).sha256());
  EXPECT_EQ(watched.payload, serial.solution);
  const v1::Meshing& meshing = watched.ended.meshing();
  EXPECT_EQ(meshing.coarse_patch_count(), 32);
  EXPECT_EQ(meshing.pilot_count(), serial.meshing.pilots);
  EXPECT_EQ(meshing.pilot_ray_count(), serial.meshing.pilot_rays);
  EXPECT_EQ(meshing.predicted_rms_area(), serial.meshing.predicted_error);
  EXPECT_EQ(meshing.reason(), serial.meshing.reason);
  const auto& items = watched.ended.plan().items();
  EXPECT_EQ(items[items.size() - 1].part(), "adapt");
  EXPECT_EQ(watched.ended.plan().patch_count(), serial.patches->size());
}

TEST_F(MeshingJob, KeepsTheLastPilotThatShotWhereItIsCancelledMeanwhile) {
  const Serial serial = SolveSerially();
  ASSERT_GT(serial.pilots.size(), 1u);
  const std::string job = CreateAdaptedJob().name();
  PatchIndex first = 0;
  AddWorker([&](const std::shared_ptr<const PatchSet>& patches, const ShootOptions& options) {
    if (first == 0) first = patches->size();
    if (patches->size() != first) {  // the second pilot's
      v1::CancelSolveJobRequest request;
      request.set_name(job);
      v1::SolveJob cancelled;
      grpc::ClientContext context;
      EXPECT_TRUE(jobs()->CancelSolveJob(&context, request, &cancelled).ok());
    }
    return Shooter::Create(patches, options);
  });
  const Watched watched = Watch(job);
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_CANCELLED);
  EXPECT_EQ(watched.payload, serial.pilots[0]);
  EXPECT_EQ(watched.ended.plan().patch_count(), first);
  EXPECT_TRUE(coordinator_->blobs().Has(watched.ended.patch_set_digest().sha256()));
  const auto& items = watched.ended.plan().items();
  EXPECT_NE(items[items.size() - 1].reason().find("it was stopped"), std::string::npos);
}

TEST_F(MeshingJob, LeavesNoPatchSetOfItsPilots) {
  AddWorker();
  const v1::SolveJob ended = Watch(CreateAdaptedJob().name()).ended;
  EXPECT_TRUE(coordinator_->blobs().Has(ended.patch_set_digest().sha256()));
  Scene scene = *LoadGltf({"room.glb", ToGlb(MakeCornell(1)), {}});
  EXPECT_FALSE(coordinator_->blobs().Has(DigestOf(EncodePatchSet(PatchesOf(scene))).sha256()));
  v1::DeleteSolveJobRequest request;
  request.set_name(ended.name());
  google::protobuf::Empty empty;
  grpc::ClientContext context;
  ASSERT_TRUE(jobs()->DeleteSolveJob(&context, request, &empty).ok());
  EXPECT_FALSE(coordinator_->blobs().Has(ended.patch_set_digest().sha256()));
}

}  // namespace
}  // namespace lambert
