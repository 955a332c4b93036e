// Four or eight numbers at once; operators, comparisons and ?: work lane by lane, each with the
// result of the same operation on one number.
#pragma once

#include <immintrin.h>

#include <cmath>
#include <cstdint>

namespace lambert {

using Float8 = float __attribute__((vector_size(32)));
using Double4 = double __attribute__((vector_size(32)));
using Long2 = int64_t __attribute__((vector_size(16)));
using Long4 = int64_t __attribute__((vector_size(32)));
using Int8 = int32_t __attribute__((vector_size(32)));
using Uint8 = uint32_t __attribute__((vector_size(32)));

// Any address.
inline Float8 LoadFloat8(const float* from) { return _mm256_loadu_ps(from); }
inline void Store(Float8 value, float* to) { _mm256_storeu_ps(to, value); }
inline Int8 LoadInt8(const int32_t* from) {
  return reinterpret_cast<Int8>(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)));
}
inline Float8 Broadcast8(float value) { return _mm256_set1_ps(value); }

// Square roots, of one number too, so that templates take either.
inline double Root(double x) { return std::sqrt(x); }
inline Float8 Root(Float8 x) { return _mm256_sqrt_ps(x); }
inline Double4 Root(Double4 x) { return _mm256_sqrt_pd(x); }
// The lesser of two numbers, without a branch.
inline double Lesser(double a, double b) {
  return _mm_cvtsd_f64(_mm_min_sd(_mm_set_sd(a), _mm_set_sd(b)));
}
// The nearest whole number, halves to even.
inline Double4 Nearest(Double4 x) {
  return _mm256_round_pd(x, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
inline Float8 Magnitude(Float8 x) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), x); }

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

// Lane l of columns[k] becomes rows[l][k], for rows of 16 numbers aligned to 64 bytes.
inline void LoadColumns16(const float* const rows[8], Float8 columns[16]) {
  for (int half = 0; half < 16; half += 8) {
    for (int l = 0; l < 8; ++l) columns[half + l] = _mm256_load_ps(rows[l] + half);
    Transpose8(columns + half);
  }
}

// A vector of numbers, or of lanes.
template <typename Real>
struct Vector {
  Real x, y, z;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(Real s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
};
template <typename Real>
Real Dot(Vector<Real> a, Vector<Real> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename Real>
Vector<Real> Cross(Vector<Real> a, Vector<Real> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace lambert
