#include "client/convert.h"

#include "gtest/gtest.h"
#include "lambert/v1/solve_spec.pb.h"
#include "net/solve_spec.h"

namespace lambert::client {
namespace {

TEST(Convert, OptionsComeBackAsTheyWent) {
  PatchOptions patch{.max_edge_m = 0.25,
                     .two_sided = true,
                     .emission_unit = EmissionUnit::kWattPerM2PerSr,
                     .metres_per_unit = 0.01,
                     .blend = Blend::kOmit,
                     .max_patches = 12345,
                     .adapt_patches = 678};
  patch.lights = {.sky = "overcast",
                  .sky_illuminance_lx = 5000,
                  .sun_azimuth_deg = 200,
                  .sun_elevation_deg = 30,
                  .sun_illuminance_lx = 9e4,
                  .lamps = {{"a.ies", "lamp"}, {"b.ies", "7"}}};
  SolveOptions solve;
  solve.shoot.method = Method::kPhs;
  solve.shoot.pyramids = {.initial = 7,
                          .split = 3,
                          .depth = 1,
                          .alpha1 = 0.25,
                          .alpha2 = 0,
                          .sampling = PyramidSampling::kSolidAngle,
                          .min_rays = 9};
  solve.shoot.parts.with.Add(Part::kColor);
  solve.shoot.parts.without.Add(Part::kClusters);
  solve.shoot.parts.without.Add(Part::kStdError);
  solve.seed = 18446744073709551615u;
  solve.max_error = 0.02;
  solve.max_rays = int64_t{1} << 40;
  solve.max_time_s = 12.5;
  solve.unsent_tolerance = 1e-4;
  solve.max_steps = 77;

  PatchOptions patch_back;
  SolveOptions solve_back;
  EXPECT_TRUE(ReadSpec(MakeSpec(patch, solve), patch_back, solve_back).ok());
  EXPECT_EQ(patch_back.max_edge_m, 0.25);
  EXPECT_TRUE(patch_back.two_sided);
  EXPECT_EQ(patch_back.emission_unit, EmissionUnit::kWattPerM2PerSr);
  EXPECT_EQ(patch_back.metres_per_unit, 0.01);
  EXPECT_EQ(patch_back.blend, Blend::kOmit);
  EXPECT_EQ(patch_back.max_patches, 12345);
  EXPECT_EQ(patch_back.lights.sky, "overcast");
  EXPECT_EQ(patch_back.lights.sky_illuminance_lx, 5000);
  EXPECT_EQ(patch_back.lights.sun_azimuth_deg, 200);
  EXPECT_EQ(patch_back.lights.sun_elevation_deg, 30);
  EXPECT_EQ(patch_back.lights.sun_illuminance_lx, 9e4);
  EXPECT_EQ(patch_back.lights.lamps, patch.lights.lamps);
  EXPECT_EQ(patch_back.adapt_patches, 678);
  const PyramidOptions& pyramids = solve_back.shoot.pyramids;
  EXPECT_EQ(solve_back.shoot.method, Method::kPhs);
  EXPECT_EQ(pyramids.initial, 7);
  EXPECT_EQ(pyramids.split, 3);
  EXPECT_EQ(pyramids.depth, 1);
  EXPECT_EQ(pyramids.alpha1, 0.25);
  EXPECT_EQ(pyramids.alpha2, 0);
  EXPECT_EQ(pyramids.sampling, PyramidSampling::kSolidAngle);
  EXPECT_EQ(solve_back.shoot.parts, solve.shoot.parts);
  EXPECT_EQ(pyramids.min_rays, 9);
  EXPECT_EQ(solve_back.seed, solve.seed);
  EXPECT_EQ(solve_back.max_error, solve.max_error);
  EXPECT_EQ(solve_back.max_rays, solve.max_rays);
  EXPECT_EQ(solve_back.max_time_s, solve.max_time_s);
  EXPECT_EQ(solve_back.unsent_tolerance, solve.unsent_tolerance);
  EXPECT_EQ(solve_back.max_steps, solve.max_steps);
}

TEST(Convert, AbsentFieldsKeepTheirDefaults) {
  PatchOptions patch;
  SolveOptions solve;
  EXPECT_TRUE(ReadSpec(v1::SolveSpec(), patch, solve).ok());
  EXPECT_EQ(patch.max_patches, PatchOptions().max_patches);
  EXPECT_EQ(solve.seed, SolveOptions().seed);
  EXPECT_EQ(solve.shoot.pyramids.depth, PyramidOptions().depth);
  EXPECT_EQ(solve.unsent_tolerance, SolveOptions().unsent_tolerance);
}

TEST(Convert, WhatIsNotKnownIsToldAndTheRestTaken) {
  v1::SolveSpec spec;
  spec.mutable_shoot()->set_method("of-tomorrow");
  (*spec.mutable_shoot()->mutable_settings())["none-such"] = "1";
  spec.set_max_error(0.25);
  PatchOptions patch;
  SolveOptions solve;
  const absl::Status status = ReadSpec(spec, patch, solve);
  EXPECT_NE(status.message().find("of-tomorrow"), std::string::npos) << status;
  EXPECT_EQ(solve.shoot.method, Method::kAuto);
  EXPECT_EQ(solve.max_error, 0.25);
}

TEST(Convert, AFailedJobCarriesItsErrorAndItsLastResult) {
  v1::SolveJob job;
  job.set_name("solveJobs/a");
  job.set_state(v1::SolveJob::STATE_FAILED);
  job.mutable_error()->set_code(8);
  job.mutable_error()->set_message("the disk is full");
  job.mutable_latest_snapshot()->set_version(3);
  job.mutable_latest_snapshot()->mutable_progress()->set_ray_count(1000);
  job.mutable_latest_snapshot()->mutable_payload_digest()->set_size_bytes(72);
  const Job result = FromProto(job);
  EXPECT_TRUE(HasEnded(result.state));
  EXPECT_EQ(result.error.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(result.snapshot_version, 3);
  EXPECT_EQ(result.snapshot_progress.rays, 1000);
  EXPECT_EQ(result.snapshot.size_bytes, 72);
  EXPECT_EQ(result.progress.unsent_fraction, 0);
}

}  // namespace
}  // namespace lambert::client
