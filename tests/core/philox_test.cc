#include "radiosity/core/philox.h"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

using Counter = std::array<uint32_t, 4>;
using Key = std::array<uint32_t, 2>;

TEST(Philox, EqualsThePublishedAnswers) {  // kat_vectors of SMDS11, philox4x32 10
  EXPECT_EQ(Philox({0, 0, 0, 0}, {0, 0}),
            (Counter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (Counter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Counter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, EqualsRandom123) {
  TestRandom random(1);
  for (int k = 0; k < 10000; ++k) {
    const uint64_t a = random.Bits(), b = random.Bits(), c = random.Bits();
    const Counter counter = {static_cast<uint32_t>(a), static_cast<uint32_t>(a >> 32),
                             static_cast<uint32_t>(b), static_cast<uint32_t>(b >> 32)};
    const Key key = {static_cast<uint32_t>(c), static_cast<uint32_t>(c >> 32)};
    const r123::Philox4x32::ctr_type theirs =
        r123::Philox4x32()({{counter[0], counter[1], counter[2], counter[3]}}, {{key[0], key[1]}});
    const Counter ours = Philox(counter, key);
    for (int l = 0; l < 4; ++l) ASSERT_EQ(ours[l], theirs[l]) << k;
  }
}

TEST(FillRandomNumbers, EqualsTheScalarNumbersBitForBit) {
  TestRandom random(2);
  for (int k = 0; k < 2000; ++k) {
    const RandomStream stream{random.Bits(), static_cast<uint32_t>(random.Bits()),
                              static_cast<uint32_t>(random.Bits()),
                              static_cast<uint32_t>(random.Below(1 << 16))};
    // The last counters wrap: a group of eight may begin at any ray.
    const uint32_t first = k == 0 ? ~0u - 3 : static_cast<uint32_t>(random.Bits());
    RandomNumbers8 group;
    FillRandomNumbers(stream, first, group);
    for (uint32_t lane = 0; lane < 8; ++lane) {
      const std::array<float, 4> one = RandomNumbers(stream, first + lane, RandomPurpose::kRay);
      for (int n = 0; n < 4; ++n) ASSERT_EQ(group.numbers[n][lane], one[n]) << k;
    }
  }
}

TEST(FillRandomBits, EqualsTheScalarBitsOfRaysOfAnyEmitters) {
  TestRandom random(4);
  const RandomStream stream{random.Bits(), 0, 7, 9};
  RayNames8 names;
  for (int lane = 0; lane < 8; ++lane) {
    names.emitter[lane] = static_cast<uint32_t>(random.Bits());
    names.ray[lane] = static_cast<uint32_t>(random.Bits());
  }
  RandomBits8 group;
  FillRandomBits(stream, names, group, RandomPurpose::kScramble);
  for (int lane = 0; lane < 8; ++lane) {
    RandomStream one = stream;
    one.emitter = names.emitter[lane];
    const auto bits = RandomBits(one, names.ray[lane], RandomPurpose::kScramble);
    for (int k = 0; k < 4; ++k) EXPECT_EQ(group.bits[k][lane], bits[k]) << lane;
  }
}

TEST(RandomNumbers, AreMultiplesOfTwoToTheMinus24UnderOne) {
  const RandomStream stream{9, 1, 2, 3};
  for (uint32_t ray = 0; ray < 20000; ++ray) {
    for (float x : RandomNumbers(stream, ray, RandomPurpose::kRay)) {
      ASSERT_TRUE(x >= 0 && x < 1);
      ASSERT_EQ(x * 0x1p24, std::floor(x * 0x1p24));
    }
  }
}

TEST(RandomNumbers, AreUniformInFourDimensions) {
  const RandomStream stream{5, 77, 3, 1};
  std::vector<int64_t> counts(256);
  for (uint32_t ray = 0; ray < 100000; ++ray) {
    int bin = 0;
    for (float x : RandomNumbers(stream, ray, RandomPurpose::kRay)) {
      bin = 4 * bin + static_cast<int>(4 * x);
    }
    ++counts[bin];
  }
  EXPECT_LT(ChiSquared(counts, std::vector<double>(256, 1.0 / 256)), ChiSquaredQuantile(255));
}

// Two equal sets of four numbers of 24 bits: once in 2^96.
TEST(RandomNumbers, EveryPartOfTheKeyAndEveryPurposeIsAStreamOfItsOwn) {
  const RandomStream base{5, 6, 7, 8};
  RandomStream seed = base, high_seed = base, emitter = base, step = base, pass = base;
  seed.seed ^= 1;
  high_seed.seed ^= uint64_t{1} << 32;
  emitter.emitter ^= 1;
  step.step ^= 1;
  pass.pass ^= 1;
  std::set<std::array<float, 4>> seen;
  int drawn = 0;
  for (const RandomStream& stream : {base, seed, high_seed, emitter, step, pass}) {
    for (RandomPurpose purpose :
         {RandomPurpose::kRay, RandomPurpose::kPyramidOffset, RandomPurpose::kPatchOffset}) {
      for (uint32_t ray = 0; ray < 100; ++ray, ++drawn) {
        seen.insert(RandomNumbers(stream, ray, purpose));
      }
    }
    for (uint32_t retry = 0; retry < 1000; ++retry, ++drawn) {
      seen.insert(RandomNumbers(stream, 0, RandomPurpose::kRetry, retry));
    }
  }
  EXPECT_EQ(seen.size(), static_cast<size_t>(drawn));
}

}  // namespace
}  // namespace lambert
