#include "radiosity/shoot/unit.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/support/landed_rays.h"

namespace lambert {
namespace {

TEST(MergeResult, AddsEveryField) {
  UnitResult a;
  a.deposits = {{1, 2, 3, 4, 0}, {5, 6, 7, 8, 3}};
  a.rests = {{6, 8, 10, 12, 7}};
  a.shot = {10, 20, 30};
  a.escaped = {1, 2, 3};
  a.rays = 12;
  a.cpu_seconds = 0.5;
  const UnitResult twice = Merged(a, a);
  EXPECT_EQ(twice.deposits[1], (Deposit{10, 12, 14, 16, 3}));
  EXPECT_EQ(twice.rests, (std::vector<Deposit>{{12, 16, 20, 24, 7}}));
  EXPECT_EQ(twice.shot, (Quanta{20, 40, 60}));
  EXPECT_EQ(twice.escaped, (Quanta{2, 4, 6}));
  EXPECT_EQ(twice.rays, 24);
  EXPECT_EQ(twice.cpu_seconds, 1);
}

TEST(WorkUnit, CountsTheRaysOfItsRanges) {
  WorkUnit unit;
  EXPECT_EQ(unit.RayCount(), 0);
  unit.visits = {{0, 100, 10, 30, {}}, {1, 5, 0, 5, {}}, {2, 4000000000u, 0, 4000000000u, {}}};
  EXPECT_EQ(unit.RayCount(), 20 + 5 + 4000000000);
}

// A result that balances: 8 rays, 5 hits, 3 escaped.
struct Booked {
  WorkUnit unit;
  UnitResult result;
};
Booked Balanced() {
  Booked booked;
  booked.unit.visits = {{0, 8, 0, 8, {80, 160, 0}}};
  booked.result.deposits = {{20, 40, 0, 2, 1}, {30, 60, 0, 3, 3}};
  booked.result.shot = {80, 160, 0};
  booked.result.escaped = {30, 60, 0};
  booked.result.rays = 8;
  return booked;
}

TEST(CheckLedger, AcceptsAResultThatBalances) {
  const Booked booked = Balanced();
  EXPECT_TRUE(CheckLedger(booked.unit, booked.result).ok());
}

TEST(CheckLedger, WalksHaveNoFewerRaysThanTheyBeginWith) {
  Booked booked = Balanced();
  booked.result.rays = 12;
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok());
  booked.unit.walks = true;
  EXPECT_TRUE(CheckLedger(booked.unit, booked.result).ok());
  booked.result.rays = 7;
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok());
}

// What the ledger cannot tell, as unit.h says: only a second run of the unit can.
TEST(CheckLedger, DoesNotNoticeWhatTheHeaderNames) {
  Booked honest = Balanced();
  honest.result.sightings = {{0, 1, 1, 1}};
  const auto accepts = [&honest](auto change) {
    UnitResult faulty = honest.result;
    change(faulty);
    return CheckLedger(honest.unit, faulty).ok() &&
           EncodeUnitResult(faulty) != EncodeUnitResult(honest.result);
  };
  EXPECT_TRUE(accepts([](UnitResult& r) { r.deposits[1].patch = 4; }));
  EXPECT_TRUE(accepts([](UnitResult& r) { r.deposits[0].hits = 1; }));
  EXPECT_TRUE(accepts([](UnitResult& r) { r.sightings[0].patch = 3; }));
  EXPECT_TRUE(accepts([](UnitResult& r) { --r.deposits[0].r, ++r.deposits[1].r; }));
  EXPECT_TRUE(accepts([](UnitResult& r) { ++r.shot[1], ++r.escaped[1]; }));
}

template <typename Forge>
void ExpectRefused(const char* what, Forge forge) {
  Booked booked = Balanced();
  forge(booked.result);
  const absl::Status status = CheckLedger(booked.unit, booked.result);
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss) << what;
  if (!status.ok()) {
    EXPECT_EQ(ReasonOf(status), "RESULT_INVALID") << what;
  }
}

TEST(CheckLedger, TheChannelsAreThoseOfTheUnit) {
  WorkUnit unit{1, 1, 1, {{0, 2, 0, 2, {6, 0, 0}}}, 0, kGrayChannels};
  UnitResult result;
  result.rays = 2;
  result.shot = {6, 0, 0};
  result.escaped = {2, 0, 0};
  result.deposits = {{4, 0, 0, 1, 3}};
  result.channels = kGrayChannels;
  EXPECT_TRUE(CheckLedger(unit, result).ok()) << CheckLedger(unit, result);
  unit.channels = kColorChannels;
  EXPECT_EQ(ReasonOf(CheckLedger(unit, result)), "RESULT_INVALID");
}

TEST(CheckLedger, WhatComesToRestIsWhatArrived) {
  Booked booked = Balanced();
  Deposit all;
  for (const Deposit& d : booked.result.deposits) {
    all = {all.r + d.r, all.g + d.g, all.b + d.b, all.hits + d.hits, 7};
  }
  booked.result.rests = {all};
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok()) << "nothing should rest";
  booked.unit.rays_per_m2 = 1;
  EXPECT_TRUE(CheckLedger(booked.unit, booked.result).ok());
  ++booked.result.rests[0].g;
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok());
  booked.result.rests = {all};
  --booked.result.rests[0].hits;
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok());
  booked.result.rests.clear();
  EXPECT_FALSE(CheckLedger(booked.unit, booked.result).ok()) << "all of it got lost";
}

TEST(CheckLedger, RefusesEachKindOfForgery) {
  ExpectRefused("one quantum more", [](UnitResult& r) { ++r.deposits[0].r; });
  ExpectRefused("one quantum less", [](UnitResult& r) { --r.deposits[1].g; });
  ExpectRefused("a quantum in a dark channel", [](UnitResult& r) { ++r.deposits[1].b; });
  ExpectRefused("more shot", [](UnitResult& r) { ++r.shot[1]; });
  ExpectRefused("more escaped", [](UnitResult& r) { ++r.escaped[0]; });
  ExpectRefused("fewer rays", [](UnitResult& r) { --r.rays; });
  ExpectRefused("more rays", [](UnitResult& r) { ++r.rays; });
  ExpectRefused("more hits than rays", [](UnitResult& r) { r.deposits[0].hits += 4; });
  ExpectRefused("flux without a hit", [](UnitResult& r) {
    r.deposits.push_back({5, 5, 0, 0, 4});
    r.deposits[0].r -= 5;
    r.deposits[0].g -= 5;
  });
  ExpectRefused("flux that escaped although every ray arrived",
                [](UnitResult& r) { r.deposits[0].hits += 3; });
  ExpectRefused("a negative deposit that another makes up for", [](UnitResult& r) {
    r.deposits[0].r -= 1000;
    r.deposits[1].r += 1000;
  });
  ExpectRefused("negative hits that others make up for", [](UnitResult& r) {
    r.deposits[0].hits -= 10;
    r.deposits[1].hits += 10;
  });
  ExpectRefused("a negative escape that a deposit makes up for", [](UnitResult& r) {
    r.escaped[0] -= 1000;
    r.deposits[1].r += 1000;
  });
}

TEST(CheckLedger, RefusesSumsThatOverflowToTheRightValue) {
  // Four times 2^62 is 0 modulo 2^64.
  ExpectRefused("overflow", [](UnitResult& r) {
    r.deposits.push_back({0, 0, 0, 1, 4});
    r.deposits.push_back({0, 0, 0, 1, 5});
    for (Deposit& d : r.deposits) d.r += int64_t{1} << 62;
  });
}

TEST(CheckLedger, SaysBothNumbers) {
  Booked booked = Balanced();
  booked.result.shot[1] = 170;
  const std::string message(CheckLedger(booked.unit, booked.result).message());
  EXPECT_NE(message.find("shot 170"), std::string::npos) << message;
  EXPECT_NE(message.find("arrived 100"), std::string::npos) << message;
}

}  // namespace
}  // namespace lambert
