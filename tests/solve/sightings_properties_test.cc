#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "radiosity/solve/sightings.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr int kCells = 5;

std::vector<Sighting> AnySightings() {
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  std::vector<Sighting> sightings;
  for (int64_t k = random.Below(100); k > 0; --k) {
    sightings.push_back({static_cast<int32_t>(random.Below(3)),
                         static_cast<int32_t>(random.Below(kCells)),
                         static_cast<PatchIndex>(random.Below(2) == 0 ? 2147483647 - random.Below(9)
                                                                      : random.Below(9)),
                         static_cast<int32_t>(1 + random.Below(kManyTimes))});
  }
  return sightings;
}

std::string TableOf(const std::vector<std::vector<Sighting>>& parts) {
  SightingTable table;
  for (const std::vector<Sighting>& part : parts) table.Add(part);
  return table.Encode();
}

RC_GTEST_PROP(SightingTable, IsFreeOfOrderAndOfParts, ()) {
  const std::vector<Sighting> a = AnySightings(), b = AnySightings(), c = AnySightings();
  const std::string table = TableOf({a, b, c});
  RC_ASSERT(TableOf({c, a, b}) == table);
  RC_ASSERT(TableOf({b, c, a}) == table);
  std::vector<Sighting> all = a;
  all.insert(all.end(), b.begin(), b.end());
  all.insert(all.end(), c.begin(), c.end());
  RC_ASSERT(TableOf({all}) == table);
  CombineSightings(all);
  RC_ASSERT(TableOf({all}) == table);
}

// As a set of patches it takes the same twice for once; how often they were seen is counted, up to
// kManyTimes.
RC_GTEST_PROP(SightingTable, KnowsNoMorePatchesFromSeeingThemAgain, ()) {
  const std::vector<Sighting> seen = AnySightings();
  SightingTable once, twice;
  once.Add(seen);
  for (int k = 0; k < 2; ++k) twice.Add(seen);
  for (int32_t emitter = 0; emitter < 3; ++emitter) {
    RC_ASSERT(once.Counts(emitter, kCells, false) == twice.Counts(emitter, kCells, false));
  }
  const std::vector<std::vector<Sighting>> many(kManyTimes, seen), more(kManyTimes + 1, seen);
  RC_ASSERT(TableOf(many) == TableOf(more));
}

}  // namespace
}  // namespace lambert
