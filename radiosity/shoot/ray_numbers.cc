#include "radiosity/shoot/ray_numbers.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "radiosity/core/lanes.h"

namespace lambert {
namespace {

constexpr int kDimensions = 4;
constexpr float kTo01 = 1.0f / 16777216.0f;  // 2^-24

// Direction numbers v[dimension][bit].
struct SobolDirections {
  uint32_t v[kDimensions][32] = {};

  constexpr SobolDirections() {
    // Degree, coefficients and first numbers of the primitive polynomials (JK08).
    constexpr int kDegree[kDimensions] = {0, 1, 2, 3};
    constexpr uint32_t kCoefficients[kDimensions] = {0, 0, 1, 1};
    constexpr uint32_t kFirst[kDimensions][3] = {{}, {1}, {1, 3}, {1, 3, 1}};
    for (int bit = 0; bit < 32; ++bit) v[0][bit] = 1u << (31 - bit);
    for (int d = 1; d < kDimensions; ++d) {
      const int s = kDegree[d];
      for (int bit = 0; bit < s; ++bit) v[d][bit] = kFirst[d][bit] << (31 - bit);
      for (int bit = s; bit < 32; ++bit) {
        uint32_t x = v[d][bit - s] ^ (v[d][bit - s] >> s);
        for (int i = 1; i < s; ++i) {
          if (kCoefficients[d] >> (s - 1 - i) & 1) x ^= v[d][bit - i];
        }
        v[d][bit] = x;
      }
    }
  }
};
constexpr SobolDirections kSobol;

// The bits in reverse order.
template <typename Bits>
constexpr Bits Reverse(Bits x) {
  x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
  x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
  x = (x & 0x0F0F0F0Fu) << 4 | (x >> 4 & 0x0F0F0F0Fu);
  x = (x & 0x00FF00FFu) << 8 | (x >> 8 & 0x00FF00FFu);
  return x << 16 | x >> 16;
}

// Each bit of the result depends on that bit and lower ones alone (LK11, constants of Vegdahl).
template <typename Bits>
inline Bits LaineKarras(Bits x, Bits seed) {
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526C56u;
  x ^= x * 0x53A22864u;
  return x;
}

// Scrambling starts and ends with a reversal, and the reversal of a sum (XOR) is the sum of the
// reversed: direction numbers in reverse spare the first.
struct ReversedDirections {
  uint32_t v[kDimensions][32] = {};
  constexpr ReversedDirections() {
    for (int d = 0; d < kDimensions; ++d) {
      for (int bit = 0; bit < 32; ++bit) v[d][bit] = Reverse(kSobol.v[d][bit]);
    }
  }
};
constexpr ReversedDirections kReversed;

// Owen-scrambled points `index` as numbers in [0, 1). seeds[d]: of a dimension, lane by lane.
inline void FillSobol(Uint8 index, const Uint8 seeds[kDimensions], RandomNumbers8& out) {
  uint32_t any = 0;
  for (int lane = 0; lane < 8; ++lane) any |= index[lane];
  const int width = std::bit_width(any);
  Uint8 points[kDimensions] = {};
  for (int bit = 0; bit < width; ++bit) {
    const Uint8 mask = 0 - (index >> bit & 1);
    for (int d = 0; d < kDimensions; ++d) points[d] ^= kReversed.v[d][bit] & mask;
  }
  for (int d = 0; d < kDimensions; ++d) {
    const Uint8 bits = Reverse(LaineKarras(points[d], seeds[d])) >> 8;
    Store(ToFloat8(reinterpret_cast<Int8>(bits)) * kTo01, out.numbers[d]);
  }
}

}  // namespace

uint32_t SobolBits(uint32_t index, int dimension) {
  uint32_t bits = 0;
  for (int bit = 0; index != 0; index >>= 1, ++bit) {
    bits ^= kSobol.v[dimension][bit] & (0u - (index & 1));
  }
  return bits;
}

uint32_t OwenScramble(uint32_t bits, uint32_t seed) {
  return Reverse(LaineKarras(Reverse(bits), seed));
}

RayNumbers::RayNumbers(const RandomStream& stream, Sequence sequence)
    : stream_(stream), sequence_(sequence) {
  if (sequence == Sequence::kSobol) scramble_ = RandomBits(stream, 0, RandomPurpose::kScramble);
}

void RayNumbers::Fill(uint32_t first, RandomNumbers8& out) const {
  if (sequence_ == Sequence::kRandom) {
    FillRandomNumbers(stream_, first, out);
    return;
  }
  Uint8 seeds[kDimensions];
  for (int d = 0; d < kDimensions; ++d) seeds[d] = Uint8{} + scramble_[d];
  FillSobol(Uint8{0, 1, 2, 3, 4, 5, 6, 7} + first, seeds, out);
}

void FillRayNumbers(const RandomStream& stream, Sequence sequence, const RayNames8& rays,
                    RandomNumbers8& out) {
  if (sequence == Sequence::kRandom) {
    FillRandomNumbers(stream, rays, out);
    return;
  }
  RayNames8 first = rays;
  std::fill_n(first.ray, 8, 0u);  // a visit's scramble is that of its emitter's ray 0
  RandomBits8 scramble;
  FillRandomBits(stream, first, scramble, RandomPurpose::kScramble);
  Uint8 index, seeds[kDimensions];
  std::memcpy(&index, rays.ray, sizeof(index));
  std::memcpy(seeds, scramble.bits, sizeof(seeds));
  FillSobol(index, seeds, out);
}

}  // namespace lambert
