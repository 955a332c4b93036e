#include <gtest/gtest.h>

#include <limits>

#include "radiosity/core/error.h"
#include "radiosity/shoot/unit.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr PatchIndex kPatches = 50;

WorkUnit MakeUnit() {
  WorkUnit unit{0x123456789abcdef0, 7, 9, {}};
  for (int k = 0; k < 12; ++k) {
    unit.visits.push_back({3 * k, 1000u + k, 10u * k, 10u * k + 5, {k, int64_t{1} << (40 + k), 0}});
  }
  unit.rays_per_m2 = 12.5;
  unit.visits[3].seen = {4, 0, 1u << 31};
  return unit;
}

UnitResult MakeResult() {
  UnitResult result;
  for (PatchIndex i = 0; i < kPatches; i += 4) {
    result.deposits.push_back({i, int64_t{1} << 40, 0, i + 1, i});
  }
  result.rests = {{5, 6, 7, 2, 3}, {1, 2, 3, 4, 2 * kPatches - 1}};
  result.shot = {1000, 2000, 3000};
  result.escaped = {1, 2, 3};
  result.rays = 777;
  result.sightings = {{0, 3, 7, 1}, {0, 4, 2, 3}, {49, 0, 0, 2}};
  return result;
}

TEST(UnitCodec, OfGrayLightOneChannelTravels) {
  const UnitResult color = MakeResult();
  UnitResult gray = color;
  gray.channels = kGrayChannels;
  for (std::vector<Deposit>* deposits : {&gray.deposits, &gray.rests}) {
    for (Deposit& d : *deposits) d.g = d.b = 0;
  }
  const std::string bytes = EncodeUnitResult(gray);
  EXPECT_EQ(bytes.size() + 16 * (gray.deposits.size() + gray.rests.size()),
            EncodeUnitResult(color).size());
  const absl::StatusOr<UnitResult> read = DecodeUnitResult(bytes, kPatches);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(*read, gray);
  SpreadGray(gray);
  EXPECT_EQ(gray.channels, kColorChannels);
  EXPECT_EQ(gray.deposits[1], (Deposit{4, 4, 4, 5, 4}));
  EXPECT_EQ(gray.rests[0], (Deposit{5, 5, 5, 2, 3}));
  EXPECT_EQ(gray.shot, (Quanta{1000, 1000, 1000}));
  EXPECT_EQ(gray.escaped, (Quanta{1, 1, 1}));

  const WorkUnit unit{1, 2, 3, {{4, 10, 0, 10, {99, 0, 0}}}, 0, kGrayChannels};
  WorkUnit in_color = unit;
  in_color.channels = kColorChannels;
  EXPECT_EQ(EncodeUnit(unit).size() + 16, EncodeUnit(in_color).size());
  ASSERT_TRUE(DecodeUnit(EncodeUnit(unit)).ok());
  EXPECT_EQ(*DecodeUnit(EncodeUnit(unit)), unit);
}

TEST(UnitCodec, RefusesPlacesBeyondThoseOfAnyTree) {
  UnitResult result = MakeResult();
  result.rests[1].patch = 2 * kPatches;
  EXPECT_FALSE(DecodeUnitResult(EncodeUnitResult(result), kPatches).ok());
}

// What `change` makes of a good result's sightings is refused.
template <typename Change>
bool Refused(Change change) {
  UnitResult result = MakeResult();
  change(result.sightings);
  return !DecodeUnitResult(EncodeUnitResult(result), kPatches).ok();
}

TEST(UnitCodec, RefusesSightingsOutOfOrderOrRange) {
  using List = std::vector<Sighting>;
  EXPECT_FALSE(Refused([](List&) {}));
  EXPECT_TRUE(Refused([](List& s) { std::swap(s[0], s[1]); }));
  EXPECT_TRUE(Refused([](List& s) { s[1] = s[0]; }));
  EXPECT_TRUE(Refused([](List& s) { s[2].emitter = kPatches; }));
  EXPECT_TRUE(Refused([](List& s) { s[2].patch = kPatches; }));
  EXPECT_TRUE(Refused([](List& s) { s[0].emitter = -1; }));
  EXPECT_TRUE(Refused([](List& s) { s[0].cell = -1; }));
  EXPECT_TRUE(Refused([](List& s) { s[0].cell = 65536; }));
  EXPECT_TRUE(Refused([](List& s) { s[0].times = 0; }));
  EXPECT_TRUE(Refused([](List& s) { s[0].times = 4; }));
}

void Damage(TestRandom& random, std::string& bytes) {
  const int flips = 1 + static_cast<int>(random.Below(3));
  for (int k = 0; k < flips; ++k) {
    bytes[random.Below(static_cast<int64_t>(bytes.size()))] ^=
        static_cast<char>(1 + random.Below(255));
  }
}

TEST(UnitCodec, RefusesEveryTruncationAndWhatFollowsTheEnd) {
  const std::string unit = EncodeUnit(MakeUnit()), result = EncodeUnitResult(MakeResult());
  for (size_t size = 0; size < unit.size(); ++size) {
    ASSERT_EQ(DecodeUnit(unit.substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
  }
  for (size_t size = 0; size < result.size(); ++size) {
    ASSERT_EQ(DecodeUnitResult(result.substr(0, size), kPatches).status().code(),
              absl::StatusCode::kDataLoss);
  }
  EXPECT_FALSE(DecodeUnit(unit + '\0').ok());
  EXPECT_FALSE(DecodeUnitResult(result + '\0', kPatches).ok());
  EXPECT_FALSE(DecodeUnit(result).ok());
  EXPECT_FALSE(DecodeUnitResult(unit, kPatches).ok());
}

// What decodes is a value: encoding it gives the damaged bytes again (but for padding and zeros).
TEST(UnitCodec, DamagedUnitsAreRefusedOrDecodeToWhatTheySay) {
  TestRandom random(1);
  const std::string bytes = EncodeUnit(MakeUnit());
  int refused = 0;
  for (int k = 0; k < 10000; ++k) {
    std::string damaged = bytes;
    Damage(random, damaged);
    const absl::StatusOr<WorkUnit> read = DecodeUnit(damaged);
    if (read.ok()) {
      ASSERT_TRUE(EncodeUnit(*read) == damaged);
    } else {
      ASSERT_EQ(ReasonOf(read.status()), "RESULT_INVALID");
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(UnitCodec, DamagedResultsAreRefusedOrAreAboutThePatchesAskedFor) {
  TestRandom random(2);
  const std::string bytes = EncodeUnitResult(MakeResult());
  const WorkUnit unit = MakeUnit();
  int refused = 0;
  for (int k = 0; k < 10000; ++k) {
    std::string damaged = bytes;
    Damage(random, damaged);
    const absl::StatusOr<UnitResult> read = DecodeUnitResult(damaged, kPatches);
    if (read.ok()) {
      for (const Deposit& d : read->deposits) ASSERT_LT(d.patch, kPatches);
      // Never a crash, whatever the numbers are.
      (void)CheckLedger(unit, *read);
    } else {
      ASSERT_EQ(ReasonOf(read.status()), "RESULT_INVALID");
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(UnitCodec, AResultAboutPatchesThatDoNotExistIsRefused) {
  const UnitResult result = MakeResult();
  const std::string bytes = EncodeUnitResult(result);
  for (PatchIndex patches : {0, 1, result.deposits.back().patch}) {
    EXPECT_EQ(DecodeUnitResult(bytes, patches).status().code(), absl::StatusCode::kDataLoss);
  }
}

TEST(UnitCodec, PatchesOutOfOrderOrTwiceAreRefused) {
  UnitResult result = MakeResult();
  const std::string bytes = EncodeUnitResult(result);
  constexpr size_t kHeader = 88, kEntry = 32, kSighting = 16;  // docs/formats.md
  ASSERT_EQ(bytes.size(), kHeader + (13 + 2) * kEntry + 3 * kSighting);
  std::string twice = bytes, swapped = bytes;
  twice.replace(kHeader + kEntry, kEntry, bytes, kHeader, kEntry);
  swapped.replace(kHeader, kEntry, bytes, kHeader + kEntry, kEntry);
  swapped.replace(kHeader + kEntry, kEntry, bytes, kHeader, kEntry);
  EXPECT_FALSE(DecodeUnitResult(twice, kPatches).ok());
  EXPECT_FALSE(DecodeUnitResult(swapped, kPatches).ok());
}

}  // namespace
}  // namespace lambert
