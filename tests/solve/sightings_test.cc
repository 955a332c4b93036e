#include "radiosity/solve/sightings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

std::vector<Sighting> Random(TestRandom& random, int count) {
  std::vector<Sighting> sightings;
  for (int k = 0; k < count; ++k) {
    sightings.push_back({static_cast<int32_t>(random.Below(3)),
                         static_cast<int32_t>(random.Below(4)),
                         static_cast<PatchIndex>(random.Below(20)), 1});
  }
  return sightings;
}

TEST(CombineSightings, SortsAndAddsUpToMany) {
  std::vector<Sighting> sightings = {
      {1, 0, 5, 1}, {0, 2, 7, 1}, {1, 0, 5, 1}, {1, 0, 4, 2}, {1, 0, 4, 2}};
  CombineSightings(sightings);
  EXPECT_EQ(sightings, (std::vector<Sighting>{{0, 2, 7, 1}, {1, 0, 4, kManyTimes}, {1, 0, 5, 2}}));
}

TEST(SightingTable, CountsWhatWasSeenWhateverTheOrderAndTheParts) {
  TestRandom random(1);
  std::vector<Sighting> sightings = Random(random, 200);
  std::map<std::pair<int32_t, int32_t>, std::map<PatchIndex, int>> by_hand;
  for (const Sighting& s : sightings) ++by_hand[{s.emitter, s.cell}][s.patch];
  SightingTable forward, backward, combined;
  forward.Add(sightings);
  for (auto s = sightings.rbegin(); s != sightings.rend(); ++s) backward.Add({*s});
  CombineSightings(sightings);
  combined.Add(sightings);
  EXPECT_EQ(forward.Encode(), backward.Encode());
  EXPECT_EQ(forward.Encode(), combined.Encode());
  for (int32_t emitter = 0; emitter < 3; ++emitter) {
    const std::vector<uint32_t> counts = forward.Counts(emitter, 4, false);
    const std::vector<uint32_t> estimates = forward.Counts(emitter, 4, true);
    for (int32_t cell = 0; cell < 4; ++cell) {
      double f1 = 0, f2 = 0;
      for (const auto& [patch, times] : by_hand[{emitter, cell}]) {
        f1 += times == 1;
        f2 += times == 2;
      }
      const double seen = static_cast<double>(by_hand[{emitter, cell}].size());
      EXPECT_EQ(counts[cell], seen);
      EXPECT_EQ(estimates[cell], std::round(seen + f1 * (f1 - 1) / (2 * (f2 + 1))));
    }
  }
  EXPECT_TRUE(forward.Counts(3, 4, false).empty());
}

TEST(SightingTable, ComesBackFromItsBytesAndRefusesOthers) {
  TestRandom random(2);
  SightingTable table;
  table.Add(Random(random, 100));
  const std::string bytes = table.Encode();
  SightingTable restored;
  ASSERT_TRUE(restored.Restore(bytes).ok());
  EXPECT_EQ(restored.Encode(), bytes);
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(restored.Restore(bytes.substr(0, size)).code(), absl::StatusCode::kDataLoss);
  }
  EXPECT_FALSE(restored.Restore(bytes + "x").ok());
}

}  // namespace
}  // namespace lambert
