// Four or eight numbers at once; operators, comparisons and ?: work lane by lane, each with the
// result of the same operation on one number.
#pragma once

#include <immintrin.h>

#include <cmath>
#include <cstdint>

namespace lambert {

using Float8 = float __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
using Long4 = int64_t __attribute__((vector_size(32)));
using Int8 = int32_t __attribute__((vector_size(32)));
using Uint8 = uint32_t __attribute__((vector_size(32)));

// Any address.
inline Float8 LoadFloat8(const float* from) { return _mm256_loadu_ps(from); }
inline void Store(Float8 value, float* to) { _mm256_storeu_ps(to, value); }
inline Float8 Broadcast8(float value) { return _mm256_set1_ps(value); }

// Square roots, of one number too, so that templates take either.
inline double Root(double x) { return std::sqrt(x); }
inline Float8 Root(Float8 x) { return _mm256_sqrt_ps(x); }
inline Double4 Root(Double4 x) { return _mm256_sqrt_pd(x); }
inline Float8 Magnitude(Float8 x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x); }

inline Double4 LowToDouble(Float8 x) { return _mm256_cvtps_pd(_mm256_castps256_ps128(x)); }
inline Double4 HighToDouble(Float8 x) { return _mm256_cvtps_pd(_mm256_extractf128_ps(x, 1)); }
inline Float8 ToFloat8(Double4 low, Double4 high) {
  return _mm256_set_m128(_mm256_cvtpd_ps(high), _mm256_cvtpd_ps(low));
}
inline Float8 ToFloat8(Int8 x) { return _mm256_cvtepi32_ps(reinterpret_cast<__m256i>(x)); }

// table[index[l]] for each lane l.
inline Int8 Gather(const int32_t* table, Int8 index) {
  return reinterpret_cast<Int8>(_mm256_i32gather_epi32(table, reinterpret_cast<__m256i>(index), 4));
}
// True where a lane of a comparison is.
inline bool AnyLane(Int8 mask) { return _mm256_movemask_ps(reinterpret_cast<__m256>(mask)) != 0; }

// rows[k] lane l becomes rows[l] lane k.
inline void Transpose8(Float8 rows[8]) {
  __m256 t[8];
  for (int k = 0; k < 8; k += 2) {
    t[k] = _mm256_unpacklo_ps(rows[k], rows[k + 1]);
    t[k + 1] = _mm256_unpackhi_ps(rows[k], rows[k + 1]);
  }
  __m256 u[8];
  for (int k = 0; k < 8; k += 4) {
    u[k] = _mm256_shuffle_ps(t[k], t[k + 2], 0x44);
    u[k + 1] = _mm256_shuffle_ps(t[k], t[k + 2], 0xEE);
    u[k + 2] = _mm256_shuffle_ps(t[k + 1], t[k + 3], 0x44);
    u[k + 3] = _mm256_shuffle_ps(t[k + 1], t[k + 3], 0xEE);
  }
  for (int k = 0; k < 4; ++k) {
    rows[k] = _mm256_permute2f128_ps(u[k], u[k + 4], 0x20);
    rows[k + 4] = _mm256_permute2f128_ps(u[k], u[k + 4], 0x31);
  }
}

}  // namespace lambert
