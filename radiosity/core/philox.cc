#include "radiosity/core/philox.h"

#include <immintrin.h>

namespace lambert {
namespace {

constexpr uint32_t kMultiplier0 = 0xD2511F53, kMultiplier1 = 0xCD9E8D57;
constexpr uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
constexpr int kRounds = 10;
constexpr float kTo01 = 1.0f / 16777216.0f;  // 2^-24

uint32_t PassAndPurpose(uint32_t pass, RandomPurpose purpose, uint32_t retry) {
  return pass << 16 | ((static_cast<uint32_t>(purpose) + retry) & 0xFFFF);
}

// High and low halves of the products of eight 32-bit lanes with a constant.
inline void MultiplyWide(__m256i x, __m256i multiplier, __m256i& high, __m256i& low) {
  const __m256i even = _mm256_mul_epu32(x, multiplier);
  const __m256i odd = _mm256_mul_epu32(_mm256_srli_epi64(x, 32), multiplier);
  low = _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA);
  high = _mm256_blend_epi32(_mm256_srli_epi64(even, 32), odd, 0xAA);
}

struct Words8 {
  __m256i word[4];
};

// Philox of eight counters under the key of `stream`.
inline Words8 Philox8(__m256i c0, __m256i c1, __m256i c2, __m256i c3, uint64_t seed) {
  const __m256i m0 = _mm256_set1_epi32(static_cast<int>(kMultiplier0));
  const __m256i m1 = _mm256_set1_epi32(static_cast<int>(kMultiplier1));
  uint32_t key0 = static_cast<uint32_t>(seed);
  uint32_t key1 = static_cast<uint32_t>(seed >> 32);
  for (int round = 0; round < kRounds; ++round) {
    __m256i high0, low0, high1, low1;
    MultiplyWide(c0, m0, high0, low0);
    MultiplyWide(c2, m1, high1, low1);
    c0 = _mm256_xor_si256(_mm256_xor_si256(high1, c1), _mm256_set1_epi32(static_cast<int>(key0)));
    c2 = _mm256_xor_si256(_mm256_xor_si256(high0, c3), _mm256_set1_epi32(static_cast<int>(key1)));
    c1 = low1;
    c3 = low0;
    key0 += kWeyl0;
    key1 += kWeyl1;
  }
  return {{c0, c1, c2, c3}};
}

inline Words8 BitsOf(const RandomStream& stream, __m256i ray, __m256i emitter,
                     RandomPurpose purpose, uint32_t retry) {
  return Philox8(ray, emitter, _mm256_set1_epi32(static_cast<int>(stream.step)),
                 _mm256_set1_epi32(static_cast<int>(PassAndPurpose(stream.pass, purpose, retry))),
                 stream.seed);
}

inline __m256i Load(const uint32_t* from) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
}

inline void StoreNumbers(const Words8& words, RandomNumbers8& out) {
  const __m256 scale = _mm256_set1_ps(kTo01);
  for (int k = 0; k < 4; ++k) {
    const __m256 value = _mm256_cvtepi32_ps(_mm256_srli_epi32(words.word[k], 8));
    _mm256_store_ps(out.numbers[k], _mm256_mul_ps(value, scale));
  }
}

}  // namespace

std::array<uint32_t, 4> Philox(std::array<uint32_t, 4> c, std::array<uint32_t, 2> key) {
  for (int round = 0; round < kRounds; ++round) {
    const uint64_t p0 = uint64_t{kMultiplier0} * c[0], p1 = uint64_t{kMultiplier1} * c[2];
    c = {static_cast<uint32_t>(p1 >> 32) ^ c[1] ^ key[0], static_cast<uint32_t>(p1),
         static_cast<uint32_t>(p0 >> 32) ^ c[3] ^ key[1], static_cast<uint32_t>(p0)};
    key[0] += kWeyl0;
    key[1] += kWeyl1;
  }
  return c;
}

std::array<uint32_t, 4> RandomBits(const RandomStream& stream, uint32_t ray, RandomPurpose purpose,
                                   uint32_t retry) {
  return Philox({ray, stream.emitter, stream.step, PassAndPurpose(stream.pass, purpose, retry)},
                {static_cast<uint32_t>(stream.seed), static_cast<uint32_t>(stream.seed >> 32)});
}

std::array<float, 4> RandomNumbers(const RandomStream& stream, uint32_t ray, RandomPurpose purpose,
                                   uint32_t retry) {
  const std::array<uint32_t, 4> bits = RandomBits(stream, ray, purpose, retry);
  std::array<float, 4> numbers;
  for (int k = 0; k < 4; ++k) numbers[k] = static_cast<float>(bits[k] >> 8) * kTo01;
  return numbers;
}

void FillRandomNumbers(const RandomStream& stream, uint32_t first, RandomNumbers8& out,
                       RandomPurpose purpose, uint32_t retry) {
  const __m256i rays = _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                        _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
  const __m256i emitter = _mm256_set1_epi32(static_cast<int>(stream.emitter));
  StoreNumbers(BitsOf(stream, rays, emitter, purpose, retry), out);
}

void FillRandomNumbers(const RandomStream& stream, const RayNames8& rays, RandomNumbers8& out,
                       RandomPurpose purpose, uint32_t retry) {
  StoreNumbers(BitsOf(stream, Load(rays.ray), Load(rays.emitter), purpose, retry), out);
}

void FillRandomBits(const RandomStream& stream, const RayNames8& rays, RandomBits8& out,
                    RandomPurpose purpose) {
  const Words8 words = BitsOf(stream, Load(rays.ray), Load(rays.emitter), purpose, 0);
  for (int k = 0; k < 4; ++k) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(out.bits[k]), words.word[k]);
  }
}

}  // namespace lambert
