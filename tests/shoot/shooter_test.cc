#include "radiosity/shoot/shooter.h"

#include <gtest/gtest.h>

#include <thread>

#include "radiosity/core/error.h"
#include "radiosity/trace/ray_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// A Cornell box with a point light and with black patches.
std::shared_ptr<const PatchSet> Patches() {
  static const std::shared_ptr<const PatchSet> patches = [] {
    PatchSet set = PatchesOf(MakeCornell(2));
    set.lights.push_back({"", {0.1, 0.2, 0.3}, {1, 1, 1}});
    for (PatchIndex i = 0; i < set.size(); i += 10) set.reflectance[i] = {};
    return std::make_shared<const PatchSet>(std::move(set));
  }();
  return patches;
}

ShootOptions Options(Method method, PyramidSampling sampling, int64_t min_rays = 40) {
  ShootOptions options;
  options.method = method;
  options.pyramids.sampling = sampling;
  options.pyramids.min_rays = min_rays;
  return options;
}

// Each way of shooting that there is.
std::vector<ShootOptions> AllOptions() {
  return {Options(Method::kPmcr, PyramidSampling::kProjectedAngle),
          Options(Method::kPhs, PyramidSampling::kProjectedAngle),
          Options(Method::kPhs, PyramidSampling::kSolidAngle)};
}

std::shared_ptr<const Shooter> Make(const ShootOptions& options) {
  return *Shooter::Create(Patches(), options);
}

// Every emitter, with few rays and with many, more quanta than rays and fewer.
WorkUnit WholeUnit() {
  TestRandom random(1);
  WorkUnit unit{99, 3, 4, {}};
  for (PatchIndex e = 0; e <= Patches()->size(); ++e) {
    const uint32_t rays = 1 + static_cast<uint32_t>(random.Below(e % 4 == 0 ? 2500 : 90));
    const int64_t scale = int64_t{1} << random.Below(50);
    unit.visits.push_back({e, rays, 0, rays, {random.Below(scale), random.Below(scale), e % 3}});
  }
  return unit;
}

Quanta Sum(const WorkUnit& unit) {
  Quanta sum{};
  for (const Visit& visit : unit.visits) {
    for (int c = 0; c < 3; ++c) sum[c] += visit.quanta[c];
  }
  return sum;
}

TEST(Shooter, LedgerBalancesExactlyInEveryChannel) {
  for (const ShootOptions& options : AllOptions()) {
    const WorkUnit unit = WholeUnit();
    const absl::StatusOr<UnitResult> result = Make(options)->Run(unit);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->rays, unit.RayCount());
    EXPECT_TRUE(CheckLedger(unit, *result).ok()) << CheckLedger(unit, *result);
    Quanta arrived{};
    for (const Deposit& d : result->deposits) {
      arrived = {arrived[0] + d.r, arrived[1] + d.g, arrived[2] + d.b};
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(arrived[c] + result->escaped[c], result->shot[c]);
      EXPECT_GT(result->escaped[c], 0) << "the box is open in front";
    }
  }
}

TEST(Shooter, PmcrShootsExactlyTheQuantaOfWholeVisits) {
  const WorkUnit unit = WholeUnit();
  EXPECT_EQ(Make(AllOptions()[0])->Run(unit)->shot, Sum(unit));
}

TEST(Shooter, TheFirstRaysOfAVisitTakeTheRemainder) {
  const auto shooter = Make(AllOptions()[0]);
  const Quanta quanta = {10, 7, 3}, expected[4] = {{3, 2, 1}, {3, 2, 1}, {2, 2, 1}, {2, 1, 0}};
  for (PatchIndex emitter : {0, Patches()->size()}) {
    for (uint32_t ray = 0; ray < 4; ++ray) {
      const WorkUnit unit{1, 0, 0, {{emitter, 4, ray, ray + 1, quanta}}};
      EXPECT_EQ(shooter->Run(unit)->shot, expected[ray]) << emitter << " " << ray;
    }
  }
}

// A random division of every visit into ranges, dealt over a random number of units.
std::vector<WorkUnit> CutAtRandom(const WorkUnit& whole, TestRandom& random) {
  std::vector<WorkUnit> units(1 + random.Below(9), {whole.seed, whole.pass, whole.step, {}});
  for (const Visit& visit : whole.visits) {
    for (uint32_t begin = 0; begin < visit.ray_count;) {
      Visit part = visit;
      part.ray_begin = begin;
      part.ray_end = std::min<uint32_t>(visit.ray_count, begin + 1 + random.Below(1500));
      units[random.Below(static_cast<int64_t>(units.size()))].visits.push_back(part);
      begin = part.ray_end;
    }
  }
  return units;
}

TEST(Shooter, ResultsHaveTheSameBytesHoweverUnitsAreCutAndInWhateverOrderTheyAreMerged) {
  TestRandom random(2);
  const WorkUnit whole = WholeUnit();
  for (const ShootOptions& options : AllOptions()) {
    const auto shooter = Make(options);
    const std::string expected = EncodeUnitResult(*shooter->Run(whole));
    for (int k = 0; k < 10; ++k) {
      UnitResult merged;
      for (const WorkUnit& unit : CutAtRandom(whole, random)) {
        const absl::StatusOr<UnitResult> result = shooter->Run(unit);
        ASSERT_TRUE(result.ok()) << result.status();
        ASSERT_TRUE(CheckLedger(unit, *result).ok()) << CheckLedger(unit, *result);
        MergeResult(*result, merged);
      }
      ASSERT_TRUE(EncodeUnitResult(merged) == expected) << "cut " << k;
    }
  }
}

TEST(Shooter, ThreadsAtOnceGetTheBytesOfOneAlone) {
  const WorkUnit unit = WholeUnit();
  for (const ShootOptions& options : AllOptions()) {
    const std::string expected = EncodeUnitResult(*Make(options)->Run(unit));
    const auto shared = Make(options);
    for (int count = 1; count <= 4; ++count) {
      std::vector<std::string> results(count);
      std::vector<std::thread> threads;
      for (std::string& result : results) {
        threads.emplace_back([&] { result = EncodeUnitResult(*shared->Run(unit)); });
      }
      for (std::thread& thread : threads) thread.join();
      for (const std::string& result : results) EXPECT_TRUE(result == expected) << count;
    }
  }
}

TEST(Shooter, SeedPassStepAndEmitterEachChangeTheRays) {
  const auto shooter = Make(AllOptions()[0]);
  const WorkUnit base{1, 2, 3, {{5, 500, 0, 500, {500, 500, 500}}}};
  WorkUnit seed = base, pass = base, step = base;
  seed.seed = uint64_t{1} << 40;
  pass.pass = 65535;
  step.step = 4;
  const std::string bytes = EncodeUnitResult(*shooter->Run(base));
  EXPECT_TRUE(EncodeUnitResult(*shooter->Run(base)) == bytes);
  for (const WorkUnit& other : {seed, pass, step}) {
    EXPECT_FALSE(EncodeUnitResult(*shooter->Run(other)) == bytes);
  }
}

TEST(Shooter, TakesVisitsOfBlackPatchesWithoutQuantaAndWithoutRays) {
  for (const ShootOptions& options : AllOptions()) {
    const auto shooter = Make(options);
    const absl::StatusOr<UnitResult> nothing = shooter->Run({1, 0, 0, {}});
    ASSERT_TRUE(nothing.ok());
    EXPECT_EQ(nothing->rays, 0);
    EXPECT_EQ(nothing->shot, Quanta{});

    const WorkUnit unit{1,
                        0,
                        0,
                        {{0, 100, 0, 100, {0, 0, 0}},    // black, and without quanta
                         {1, 100, 40, 40, {7, 8, 9}},    // an empty range
                         {2, 0, 0, 0, {7, 8, 9}},        // no rays at all
                         {3, 100, 0, 100, {0, 7, 0}}}};  // fewer quanta than rays
    const absl::StatusOr<UnitResult> result = shooter->Run(unit);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->rays, 200);
    EXPECT_EQ(result->shot[0], 0);
    EXPECT_EQ(result->shot[2], 0);
    EXPECT_TRUE(CheckLedger(unit, *result).ok());
  }
}

TEST(Shooter, RefusesUnitsThatNameWhatDoesNotExist) {
  const PatchIndex lights_end = Patches()->size() + 1;
  for (const ShootOptions& options : AllOptions()) {
    const auto shooter = Make(options);
    for (const Visit& visit : std::vector<Visit>{{-1, 5, 0, 5, {}},
                                                 {lights_end, 5, 0, 5, {}},
                                                 {1, 5, 0, 6, {}},
                                                 {1, 5, 4, 3, {}},
                                                 {1, 5, 0, 5, {-1, 0, 0}},
                                                 {1, 5, 0, 5, {0, 0, INT64_MIN}},
                                                 {1, 5, 0, 5, {0, 0, kMaxUnitQuanta}},
                                                 {1, 5, 0, 5, {INT64_MAX, 0, 0}}}) {
      const WorkUnit unit{1, 0, 0, {{0, 1, 0, 1, {0, 0, 1}}, visit}};
      const absl::StatusOr<UnitResult> result = shooter->Run(unit);
      ASSERT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
      EXPECT_EQ(ReasonOf(result.status()), "FIELD_INVALID");
    }
    EXPECT_EQ(shooter->Run({1, 1u << 16, 0, {}}).status().code(),
              absl::StatusCode::kInvalidArgument);
  }
}

// kMaxUnitQuanta: where each ray carries what it may carry at most, the sum still fits.
TEST(Shooter, ShootsAsManyQuantaAsFit) {
  for (const ShootOptions& options : AllOptions()) {
    const WorkUnit unit{1, 0, 0, {{0, 500, 0, 500, {kMaxUnitQuanta, 0, kMaxUnitQuanta}}}};
    const absl::StatusOr<UnitResult> result = Make(options)->Run(unit);
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_TRUE(CheckLedger(unit, *result).ok()) << CheckLedger(unit, *result);
    EXPECT_GT(result->shot[0], kMaxUnitQuanta / 2);
    WorkUnit parts{1, 0, 0, {unit.visits[0], unit.visits[0]}};
    parts.visits[0].ray_end = parts.visits[1].ray_begin = 200;
    EXPECT_EQ(Make(options)->Run(parts)->deposits, result->deposits);
  }
}

TEST(Shooter, OfExactRefusesMoreQuantaThanItsSolutionHasRoomFor) {
  ShootOptions options;
  options.method = Method::kExact;
  const auto shooter = Make(options);
  EXPECT_TRUE(shooter->Run({1, 0, 0, {{0, 5, 0, 5, {int64_t{1} << 60, 0, 0}}}}).ok());
  EXPECT_EQ(shooter->Run({1, 0, 0, {{0, 5, 0, 5, {int64_t{1} << 62, 0, 0}}}}).status().code(),
            absl::StatusCode::kInvalidArgument);
}

TEST(Shooter, OfAGrayJobTakesUnitsOfOneChannelAndReturnsTheFirstOfThree) {
  for (ShootOptions options : AllOptions()) {
    WorkUnit unit = WholeUnit();
    const UnitResult color = *Make(options)->Run(unit);
    options.parts.without.Add(Part::kColor);
    const auto gray_shooter = Make(options);
    EXPECT_EQ(gray_shooter->Run(unit).status().code(), absl::StatusCode::kInvalidArgument);
    unit.channels = kGrayChannels;
    for (Visit& visit : unit.visits) visit.quanta = {visit.quanta[0], 0, 0};
    EXPECT_EQ(Make(AllOptions().front())->Run(unit).status().code(),
              absl::StatusCode::kInvalidArgument);
    UnitResult gray = *gray_shooter->Run(unit), expected = color;
    SpreadGray(gray);
    SpreadGray(expected);
    gray.cpu_seconds = expected.cpu_seconds = 0;
    EXPECT_EQ(gray, expected);
  }
}

TEST(Shooter, IsNotMadeFromInvalidOptions) {
  ShootOptions options;
  options.pyramids.split = 5;
  const auto shooter = Shooter::Create(Patches(), options);
  ASSERT_FALSE(shooter.ok());
  EXPECT_EQ(GetErrorDetail(shooter.status())->where, "phs-split");
}

TEST(UnitVersion, NamesTheTracerAndItsPins) {
  EXPECT_NE(UnitVersion().find(TracerPins()), std::string::npos);
  EXPECT_NE(UnitVersion().find("avx2"), std::string::npos);
  EXPECT_EQ(UnitVersion(), UnitVersion());
}

}  // namespace
}  // namespace lambert
