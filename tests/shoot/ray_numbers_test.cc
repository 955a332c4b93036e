#include "radiosity/shoot/ray_numbers.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

// Elementary intervals: 2^k points, one in each box of volume 2^-k, whatever its sides (a (0,k,2)
// net), in the first two dimensions and in the last two up to the sequence's quality.
void ExpectNet(const std::vector<std::array<uint32_t, 4>>& points, int k, int d0, int d1,
               int quality) {
  for (int first = 0; first <= k - quality; ++first) {
    const int second = k - quality - first;
    std::map<uint64_t, int> counts;
    for (const auto& p : points) {
      const uint64_t x = first == 0 ? 0 : p[d0] >> (32 - first);
      const uint64_t y = second == 0 ? 0 : p[d1] >> (32 - second);
      ++counts[x << 32 | y];
    }
    EXPECT_EQ(counts.size(), size_t{1} << (k - quality)) << first;
    for (const auto& [box, count] : counts) EXPECT_EQ(count, 1 << quality);
  }
}

std::vector<std::array<uint32_t, 4>> Points(int k, bool scrambled) {
  std::vector<std::array<uint32_t, 4>> points(size_t{1} << k);
  for (uint32_t i = 0; i < points.size(); ++i) {
    for (int d = 0; d < 4; ++d) {
      const uint32_t bits = SobolBits(i, d);
      points[i][d] = scrambled ? OwenScramble(bits, 77u + static_cast<uint32_t>(d)) : bits;
    }
  }
  return points;
}

TEST(Sobol, FillsEveryElementaryIntervalAlsoWhenScrambled) {
  for (bool scrambled : {false, true}) {
    ExpectNet(Points(8, scrambled), 8, 0, 1, 0);
    ExpectNet(Points(8, scrambled), 8, 2, 3, 1);
    for (int d = 0; d < 4; ++d) {
      std::set<uint32_t> strata;
      for (const auto& p : Points(8, scrambled)) strata.insert(p[d] >> 24);
      EXPECT_EQ(strata.size(), 256u) << d;
    }
  }
}

TEST(Sobol, BeginsLikeThePublishedSequence) {
  EXPECT_EQ(SobolBits(1, 0), 0x80000000u);
  EXPECT_EQ(SobolBits(2, 0), 0x40000000u);
  EXPECT_EQ(SobolBits(1, 1), 0x80000000u);
  EXPECT_EQ(SobolBits(2, 1), 0xC0000000u);
  EXPECT_EQ(SobolBits(3, 1), 0x40000000u);
  EXPECT_EQ(SobolBits(2, 2), 0xC0000000u);
  EXPECT_EQ(SobolBits(0, 3), 0u);
}

TEST(OwenScramble, IsAPermutationThatIsUniformOverSeeds) {
  std::set<uint32_t> images;
  for (uint32_t x = 0; x < 4096; ++x) images.insert(OwenScramble(x << 20, 5) >> 20);
  EXPECT_EQ(images.size(), 4096u);
  std::vector<int64_t> counts(64);
  TestRandom random(3);
  for (int k = 0; k < 64000; ++k) {
    ++counts[OwenScramble(0x12345678u, static_cast<uint32_t>(random.Bits())) >> 26];
  }
  EXPECT_LT(ChiSquared(counts, std::vector<double>(64, 1.0 / 64)), ChiSquaredQuantile(63));
}

TEST(RayNumbers, AreThoseOfTheStreamOrOfItsScrambledSequence) {
  const RandomStream stream{5, 6, 7, 8};
  RandomNumbers8 ours, theirs;
  RayNumbers(stream).Fill(24, ours);
  FillRandomNumbers(stream, 24, theirs);
  EXPECT_EQ(std::memcmp(&ours, &theirs, sizeof(ours)), 0);
  const RayNumbers sobol(stream, Sequence::kSobol), again(stream, Sequence::kSobol);
  EXPECT_EQ(sobol.stream().emitter, 6u);
  const RayNumbers other({5, 6, 7, 9}, Sequence::kSobol);
  RandomNumbers8 a, b, c;
  sobol.Fill(3, a);  // not a multiple of eight
  again.Fill(4, b);
  other.Fill(3, c);
  int differ = 0;
  for (int d = 0; d < 4; ++d) {
    for (int lane = 0; lane < 7; ++lane) EXPECT_EQ(a.numbers[d][lane + 1], b.numbers[d][lane]);
    for (int lane = 0; lane < 8; ++lane) {
      EXPECT_GE(a.numbers[d][lane], 0);
      EXPECT_LT(a.numbers[d][lane], 1);
      differ += a.numbers[d][lane] != c.numbers[d][lane];
    }
  }
  EXPECT_EQ(differ, 32);
}

}  // namespace
}  // namespace lambert
