#include "radiosity/shoot/walk_flight.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/shoot/shooter.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

ShootOptions Of(Method method) {
  ShootOptions options;
  options.method = method;
  return options;
}

absl::StatusOr<UnitResult> RunUnit(const PatchSet& patches, Method method, WorkUnit unit) {
  unit.walks = method == Method::kWalk;
  return (*Shooter::Create(std::make_shared<const PatchSet>(patches), Of(method)))->Run(unit);
}

constexpr uint32_t kRays = 3000;
constexpr int64_t kQuanta = int64_t{1} << 40;

WorkUnit FromTheFirstPatch(uint32_t pass = 0) {
  return {7, pass, 0, {{0, kRays, 0, kRays, {kQuanta, kQuanta, kQuanta}}}};
}

TEST(WalkFlight, EndsAtTheFirstHitOfABlackRoomAsOtherRaysDo) {
  const PatchSet room = PatchesOf(MakeBox(1, {}, std::vector<Rgb>(6, {1, 1, 1}), 2));
  const UnitResult walked = *RunUnit(room, Method::kWalk, FromTheFirstPatch());
  const UnitResult shot = *RunUnit(room, Method::kPmcr, FromTheFirstPatch());
  EXPECT_EQ(EncodeUnitResult(walked), EncodeUnitResult(shot));
}

// Of a gray room with reflectance rho a walk has 1 / (1 - rho) rays in the mean, and each carries
// what it began with; their number is geometric.
TEST(WalkFlight, GoesOnAsOftenAsLightIsReflected) {
  constexpr double kRho = 0.75;
  const PatchSet room = PatchesOf(MakeFurnace(kRho, 1, 2));
  double sum = 0;
  constexpr int kUnits = 20;
  for (uint32_t pass = 0; pass < kUnits; ++pass) {
    const absl::StatusOr<UnitResult> result = RunUnit(room, Method::kWalk, FromTheFirstPatch(pass));
    ASSERT_TRUE(result.ok()) << result.status();
    sum += static_cast<double>(result->rays);
    EXPECT_NEAR(static_cast<double>(result->shot[0]) / kQuanta,
                static_cast<double>(result->rays) / kRays, 1e-6);
    EXPECT_EQ(result->escaped, Quanta{}) << "it is closed";
  }
  const double walks = static_cast<double>(kUnits) * kRays;
  const double std_error = std::sqrt(kRho / walks) / (1 - kRho);
  EXPECT_NEAR(sum / walks, 1 / (1 - kRho), 4 * std_error);
}

TEST(WalkFlight, AWalkHasTheSameRaysInWhateverUnitItIs) {
  const PatchSet room = PatchesOf(MakeCornell(2));
  const std::string whole = EncodeUnitResult(*RunUnit(room, Method::kWalk, FromTheFirstPatch()));
  UnitResult merged;
  for (uint32_t begin = 0, length = 1; begin < kRays; begin += length, length = 2 * length + 3) {
    WorkUnit part = FromTheFirstPatch();
    part.visits[0].ray_begin = begin;
    part.visits[0].ray_end = std::min(kRays, begin + length);
    const absl::StatusOr<UnitResult> result = RunUnit(room, Method::kWalk, part);
    ASSERT_TRUE(result.ok()) << result.status();
    part.walks = true;
    EXPECT_TRUE(CheckLedger(part, *result).ok()) << CheckLedger(part, *result);
    EXPECT_GT(result->rays, part.RayCount());
    MergeResult(*result, merged);
  }
  EXPECT_TRUE(EncodeUnitResult(merged) == whole);
}

TEST(WalkFlight, AStepOfItsOwnHasRaysOfItsOwn) {
  const PatchSet room = PatchesOf(MakeCornell(2));
  WorkUnit next = FromTheFirstPatch();
  next.step = 1;
  const UnitResult a = *RunUnit(room, Method::kWalk, FromTheFirstPatch());
  const UnitResult b = *RunUnit(room, Method::kWalk, next);
  EXPECT_NE(a.deposits, b.deposits);
}

TEST(WalkFlight, AWhiteRoomWithoutAWayOutIsAnErrorAndNoEndlessLoop) {
  const PatchSet room = PatchesOf(MakeFurnace(1, 1, 1));
  const absl::Status status = RunUnit(room, Method::kWalk, FromTheFirstPatch()).status();
  EXPECT_EQ(ReasonOf(status), "SINGULAR_CLOSED_RHO_1") << status;
}

Vec3 ToVec(const float v[3]) { return {v[0], v[1], v[2]}; }

// Points that rounding has put outside a patch are moved to its edge.
TEST(AppendCosineRays, ThatGoOnStartAtTheirPointsAndGoWhereOthersGo) {
  const PatchSet patches = PatchesOf(MakeCornell(1));
  const auto scene = *RayScene::Create(patches);
  const Emitters emitters(patches, *scene);
  const float u[8] = {0, 1, 0, 0.25f, 0.5f, -1e-4f, 0.7f, 1.0002f};
  const float v[8] = {0, 0, 1, 0.25f, 0.5f, 0.3f, 0.4f, -1e-5f};
  const float b1[8] = {0, 1, 0, 0.25f, 0.5f, 0, 0.7f / 1.1f, 1};
  const float b2[8] = {0, 0, 1, 0.25f, 0.5f, 0.3f, 0.4f / 1.1f, 0};
  constexpr uint32_t kPatch = 20;
  RayNames8 names;
  for (uint32_t lane = 0; lane < 8; ++lane) {
    names.emitter[lane] = kPatch;
    names.ray[lane] = lane;
  }
  RandomNumbers8 numbers;
  FillRandomNumbers({5, 0, 0, 0}, names, numbers);
  RayBatch onward, others;
  AppendCosineRays(emitters.Frames(names.emitter), numbers, 8, others);
  AppendCosineRays(emitters.Frames(names.emitter), u, v, numbers.numbers + 2, 7, onward);
  ASSERT_EQ(onward.size, 7);
  const EmitterFrame& frame = emitters.Frame(kPatch);
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(onward.direction_x[k], others.direction_x[k]);
    EXPECT_EQ(onward.direction_y[k], others.direction_y[k]);
    EXPECT_EQ(onward.direction_z[k], others.direction_z[k]);
    const Vec3 point = ToVec(frame.corner) + ToVec(frame.edge1) * b1[k] +
                       ToVec(frame.edge2) * b2[k] + ToVec(frame.z) * kOriginOffset;
    const Vec3 origin{onward.origin_x[k], onward.origin_y[k], onward.origin_z[k]};
    EXPECT_LT(Length(origin - point), 3e-5) << k;
    EXPECT_NEAR(Dot(origin - ToVec(frame.corner), ToVec(frame.z)), kOriginOffset, 3e-7) << k;
  }
}

TEST(WalkFlight, AUnitOfAnotherMethodIsRefused) {
  const PatchSet room = PatchesOf(MakeFurnace(0.5));
  const auto shooter = *Shooter::Create(std::make_shared<const PatchSet>(room), Of(Method::kWalk));
  EXPECT_EQ(ReasonOf(shooter->Run(FromTheFirstPatch()).status()), "FIELD_INVALID");
}

}  // namespace
}  // namespace lambert
