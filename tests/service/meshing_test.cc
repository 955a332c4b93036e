// Jobs whose patches are split where light needs it.
#include <gtest/gtest.h>

#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/solver.h"
#include "server/jobs/spec.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1'000'000, kPatches = 3000;

// A scene and what is asked for.
struct Adaptable {
  std::string glb;
  v1::SolveSpec spec;
  int64_t coarse = 0;  // patches
};

Adaptable WithPatches(const Scene& scene) {
  Adaptable adaptable{ToGlb(scene), {}, PatchesOf(scene).size()};
  adaptable.spec.set_max_ray_count(kRays);
  adaptable.spec.mutable_patch()->set_adapt_patch_count(kPatches);
  return adaptable;
}

Adaptable Cornell() { return WithPatches(MakeCornell(1)); }

// A table on the ground, under a sky and the sun.
Adaptable Table() {
  const Paint gray{{0.5, 0.5, 0.5}, {}, true};
  Adaptable adaptable = WithPatches(SceneMaker()
                                        .Quad({-3, 0, -3}, {0, 0, 6}, {6, 0, 0}, gray)
                                        .Quad({-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, gray)
                                        .Make());
  v1::LightSpec& lights = *adaptable.spec.mutable_patch()->mutable_lights();
  lights.set_sky("overcast");
  lights.set_sun_elevation_degrees(60);
  lights.set_sun_illuminance_lux(50'000);
  return adaptable;
}

// What a job is without a network.
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

Serial SolveSerially(const Adaptable& adaptable) {
  const Scene scene = *LoadGltf({"room.glb", adaptable.glb, {}});
  const auto [patch, options] = *server::DecodeSpec(adaptable.spec, PatchOptions().max_patches);
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
  v1::SolveJob CreateAdaptedJob(const Adaptable& adaptable) {
    v1::Scene scene;
    EXPECT_TRUE(CreateScene(adaptable.glb, &scene).ok());
    v1::CreateSolveJobRequest request;
    request.set_scene(scene.name());
    *request.mutable_spec() = adaptable.spec;
    v1::SolveJob job;
    grpc::ClientContext context;
    EXPECT_TRUE(jobs()->CreateSolveJob(&context, request, &job).ok());
    return job;
  }
};

class AdaptedScene : public MeshingJob, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(, AdaptedScene, testing::Values("Cornell", "Table"),
                         [](const auto& info) { return info.param; });

TEST_P(AdaptedScene, HasTheBytesOfTheLoopWithoutANetworkAndTellsWhatItDid) {
  const Adaptable adaptable = GetParam() == "Table" ? Table() : Cornell();
  const Serial serial = SolveSerially(adaptable);
  ASSERT_GT(serial.patches->size(), 64);
  ASSERT_GT(serial.pilots.size(), 1u);
  AddWorker();
  AddWorker();
  const Watched watched = Watch(CreateAdaptedJob(adaptable).name());
  EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  EXPECT_EQ(watched.ended.patch_set_digest().sha256(),
            DigestOf(EncodePatchSet(*serial.patches)).sha256());
  EXPECT_EQ(watched.payload, serial.solution);
  const v1::Meshing& meshing = watched.ended.meshing();
  EXPECT_EQ(meshing.coarse_patch_count(), adaptable.coarse);
  EXPECT_EQ(meshing.pilot_count(), serial.meshing.pilots);
  EXPECT_EQ(meshing.pilot_ray_count(), serial.meshing.pilot_rays);
  EXPECT_EQ(meshing.predicted_rms_area(), serial.meshing.predicted_error);
  EXPECT_EQ(meshing.reason(), serial.meshing.reason);
  const auto& items = watched.ended.plan().items();
  EXPECT_EQ(items[items.size() - 1].part(), "adapt");
  EXPECT_EQ(watched.ended.plan().patch_count(), serial.patches->size());
}

TEST_F(MeshingJob, KeepsTheLastPilotThatShotWhereItIsCancelledMeanwhile) {
  const Serial serial = SolveSerially(Cornell());
  ASSERT_GT(serial.pilots.size(), 1u);
  const std::string job = CreateAdaptedJob(Cornell()).name();
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
  const v1::SolveJob ended = Watch(CreateAdaptedJob(Cornell()).name()).ended;
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
