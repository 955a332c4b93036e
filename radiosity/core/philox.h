// Philox4x32-10 (SMDS11): random numbers as a pure function of a counter and a key.
//
// The counter of a ray names it: (ray, emitter, step, pass and purpose); the key is the seed. So a
// ray's numbers depend on nothing that other rays, threads or workers do.
#pragma once

#include <array>
#include <cstdint>

namespace lambert {

// What a ray's numbers are for; each purpose is a stream of its own.
enum class RandomPurpose : uint32_t {
  kRay = 0,            // position on the emitter and direction
  kPyramidOffset = 1,  // start of the systematic rounding over pyramids
  kPatchOffset = 2,    // start of the systematic rounding over patches
  kScramble = 3,       // of a visit's Sobol sequence
  kPair = 4,           // points of two patches that may see each other (exact)
  kPilot = 5,          // the same, for a first look
  kClosure = 6,        // rays that look for a way out of the scene (exact)
  kRetry = 8,          // + k: the k-th retry of a rejected direction
  kBounce = 1 << 15,   // + k: of walks of step k, where `step` is the bounce (walk)
};

struct RandomStream {
  uint64_t seed = 0;
  uint32_t emitter = 0, step = 0, pass = 0;
};

// Ten rounds of Philox4x32.
std::array<uint32_t, 4> Philox(std::array<uint32_t, 4> counter, std::array<uint32_t, 2> key);

// Four numbers for one ray, uniform in [0, 1), multiples of 2^-24. Requires: pass < 2^16.
std::array<float, 4> RandomNumbers(const RandomStream& stream, uint32_t ray, RandomPurpose purpose,
                                   uint32_t retry = 0);

// The 128 bits that they are made of.
std::array<uint32_t, 4> RandomBits(const RandomStream& stream, uint32_t ray, RandomPurpose purpose,
                                   uint32_t retry = 0);

// The same numbers for rays first .. first + 7: numbers[k][lane].
struct alignas(32) RandomNumbers8 {
  float numbers[4][8];
};
void FillRandomNumbers(const RandomStream& stream, uint32_t first, RandomNumbers8& out,
                       RandomPurpose purpose = RandomPurpose::kRay, uint32_t retry = 0);

// Eight rays of any emitters.
struct alignas(32) RayNames8 {
  uint32_t emitter[8], ray[8];
};
// The same numbers, and the bits that they are made of, for eight rays that differ from `stream` in
// the emitter: [k][lane].
void FillRandomNumbers(const RandomStream& stream, const RayNames8& rays, RandomNumbers8& out,
                       RandomPurpose purpose = RandomPurpose::kRay, uint32_t retry = 0);
struct alignas(32) RandomBits8 {
  uint32_t bits[4][8];
};
void FillRandomBits(const RandomStream& stream, const RayNames8& rays, RandomBits8& out,
                    RandomPurpose purpose);

}  // namespace lambert
