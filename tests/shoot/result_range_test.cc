// A result cut by patches and put together again.
#include "radiosity/shoot/result_range.h"

#include <gtest/gtest.h>

#include <random>

namespace lambert {
namespace {

constexpr PatchIndex kPatches = 101;

UnitResult RandomResult(unsigned seed) {
  std::mt19937 random(seed);
  UnitResult result;
  for (PatchIndex place = 0; place < 2 * kPatches; ++place) {
    const auto quanta = static_cast<int64_t>(random() % 1000);
    const Deposit deposit{quanta, quanta + 1, quanta + 2, 1 + quanta % 3, place};
    if (place < kPatches && random() % 2 == 0) result.deposits.push_back(deposit);
    if (random() % 2 == 0) result.rests.push_back(deposit);
    if (place < kPatches && random() % 3 == 0) result.sightings.push_back({place, 1, 2, 1});
  }
  result.shot = {9, 8, 7};
  result.escaped = {3, 2, 1};
  result.rays = 1000;
  return result;
}

TEST(ResultRange, RangesAndTheLedgerAreTheWholeResultOnce) {
  const UnitResult whole = RandomResult(1);
  for (const int parts : {1, 2, 3, 7, 101}) {
    UnitResult together = LedgerOf(whole);
    for (int i = 0; i < parts; ++i) {
      const PatchIndex begin = kPatches * i / parts, end = kPatches * (i + 1) / parts;
      const UnitResult range = RangeOf(whole, begin, end);
      EXPECT_TRUE(IsRange(range, begin, end));
      AppendRange(range, together);
    }
    EXPECT_EQ(together, whole) << parts;
  }
}

TEST(ResultRange, OfASumIsTheSumOfTheRanges) {
  UnitResult sum, range;
  for (const unsigned seed : {2u, 3u, 4u}) {
    MergeResult(RandomResult(seed), sum);
    MergeResult(RangeOf(RandomResult(seed), 30, 60), range);
  }
  EXPECT_EQ(RangeOf(sum, 30, 60), range);
}

TEST(ResultRange, KnowsWhatIsNone) {
  const UnitResult whole = RandomResult(5);
  EXPECT_FALSE(IsRange(whole, 0, kPatches));  // it has a ledger
  EXPECT_FALSE(IsRange(RangeOf(whole, 0, 50), 0, 40));
  EXPECT_FALSE(IsRange(RangeOf(whole, 0, 50), 10, 50));
  EXPECT_TRUE(IsRange(RangeOf(whole, 0, 0), 50, 60));
}

}  // namespace
}  // namespace lambert
