// What rapidcheck draws for properties of unit results: rays that have landed somewhere.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <vector>

#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_batch.h"

namespace lambert {

struct LandedRay {
  PatchIndex patch = kEscaped;
  Quanta quanta{};
};

// Up to 100 rays, some of which escape; with 0 .. most_quanta each.
inline rc::Gen<std::vector<LandedRay>> LandedRays(PatchIndex patches, int64_t most_quanta) {
  const auto ray = rc::gen::construct<LandedRay>(
      rc::gen::inRange(kEscaped, patches),
      rc::gen::container<Quanta>(rc::gen::inRange(int64_t{0}, most_quanta)));
  return rc::gen::container<std::vector<LandedRay>>(ray);
}

// The result of a unit of these rays, in any order. With `refined`, each place of a patch holds
// what arrived at that patch or the next.
inline UnitResult ResultOf(const std::vector<LandedRay>& rays, bool refined = false) {
  UnitResult result;
  for (const auto& [patch, quanta] : rays) {
    UnitResult one;
    one.rays = 1;
    one.shot = quanta;
    if (patch == kEscaped) {
      one.escaped = quanta;
    } else {
      one.deposits = {{quanta[0], quanta[1], quanta[2], 1, patch}};
      if (refined) one.rests = {{quanta[0], quanta[1], quanta[2], 1, patch / 2 * 2}};
    }
    MergeResult(one, result);
  }
  return result;
}

inline UnitResult Merged(const UnitResult& a, const UnitResult& b) {
  UnitResult sum = a;
  MergeResult(b, sum);
  return sum;
}

}  // namespace lambert
