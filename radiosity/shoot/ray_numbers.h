// The numbers that rays are made of: independent, or spread evenly over the rays of a visit.
#pragma once

#include <array>
#include <cstdint>

#include "radiosity/core/philox.h"

namespace lambert {

enum class Sequence : uint8_t {
  kRandom = 0,  // independent numbers (philox.h)
  kSobol = 1,   // a four-dimensional Sobol sequence, Owen-scrambled anew for every visit (Owe97)
};

// Four numbers for each ray of a visit, uniform in [0, 1), multiples of 2^-24: a pure function of
// the stream and the ray, whatever the sequence.
class RayNumbers {
 public:
  // Not explicit: a stream alone means independent numbers.
  RayNumbers(const RandomStream& stream, Sequence sequence = Sequence::kRandom);

  const RandomStream& stream() const { return stream_; }
  // Of rays first .. first + 7: numbers[k][lane].
  void Fill(uint32_t first, RandomNumbers8& out) const;

 private:
  RandomStream stream_;
  Sequence sequence_;
  std::array<uint32_t, 4> scramble_{};  // of each dimension
};

// The same for eight rays of any emitters, which differ from `stream` in the emitter.
void FillRayNumbers(const RandomStream& stream, Sequence sequence, const RayNames8& rays,
                    RandomNumbers8& out);

// Point `index` of the unscrambled Sobol sequence in base 2 (direction numbers of JK08), as 32 bits
// after the point. Requires: 0 <= dimension < 4.
uint32_t SobolBits(uint32_t index, int dimension);

// Nested uniform scrambling of 32 bits by a hash (Bur20): every bit is flipped depending on `seed`
// and all bits before it.
uint32_t OwenScramble(uint32_t bits, uint32_t seed);

}  // namespace lambert
