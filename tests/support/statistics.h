// What samplers and estimators may return when they are right: thresholds from the distribution.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "radiosity/core/vec3.h"

namespace lambert {

// Thresholds stand this many standard deviations out: a right sampler passes all but once in 32,000
// seeds, and tests fix their seeds.
inline constexpr double kSigmas = 4;

// The value that a chi-squared variable of `degrees` of freedom exceeds as rarely as a normal
// variable exceeds `sigmas` (Wilson and Hilferty 1931):  k (1 - 2/(9k) + z sqrt(2/(9k)))^3
inline double ChiSquaredQuantile(double degrees, double sigmas = kSigmas) {
  const double v = 2 / (9 * degrees);
  return degrees * std::pow(1 - v + sigmas * std::sqrt(v), 3);
}

// sum (counted - expected)^2 / expected over the bins. Requires: probabilities > 0 that sum to 1;
// counts of enough samples that every bin expects five or more.
inline double ChiSquared(const std::vector<int64_t>& counts,
                         const std::vector<double>& probabilities) {
  int64_t total = 0;
  for (int64_t count : counts) total += count;
  double sum = 0;
  for (size_t k = 0; k < counts.size(); ++k) {
    const double expected = probabilities[k] * static_cast<double>(total);
    const double difference = static_cast<double>(counts[k]) - expected;
    sum += difference * difference / expected;
  }
  return sum;
}

// Between which the mean of `count` squared standard normal variables lies: z^2 has mean 1 and
// variance 2, so their sum is chi-squared with `count` degrees of freedom.
struct Limits {
  double low = 0, high = 0;
};
inline Limits MeanZ2Limits(int count, double sigmas = kSigmas) {
  return {ChiSquaredQuantile(count, -sigmas) / count, ChiSquaredQuantile(count, sigmas) / count};
}

// Mean of independent samples and its standard error (Welford).
class SampleMean {
 public:
  void Add(double sample) {
    ++count_;
    const double delta = sample - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (sample - mean_);
  }
  double mean() const { return mean_; }
  // Requires: two samples.
  double std_error() const {
    const double n = static_cast<double>(count_);
    return std::sqrt(squares_ / (n - 1) / n);
  }

 private:
  int64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

// The generator of tests: its numbers are the same everywhere (std::distributions are not).
class TestRandom {
 public:
  explicit TestRandom(uint64_t seed) : engine_(seed) {}
  uint64_t Bits() { return engine_(); }
  // 0 .. bound - 1.
  int64_t Below(int64_t bound) {
    return static_cast<int64_t>(engine_() % static_cast<uint64_t>(bound));
  }
  double Uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  // Uniform over the unit sphere.
  Vec3 Direction() {
    for (;;) {
      const Vec3 p{Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1)};
      const double length = Length(p);
      if (length <= 1 && length > 0.01) return p / length;
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace lambert
