#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/shoot/unit.h"
#include "tests/support/landed_rays.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr PatchIndex kPatches = 12;

// Any number at all, the ends of int64 more often than chance has it.
int64_t AnyNumber(TestRandom& random) {
  constexpr int64_t kEnds[] = {0,
                               1,
                               -1,
                               int64_t{1} << 60,
                               std::numeric_limits<int64_t>::max(),
                               std::numeric_limits<int64_t>::min()};
  if (random.Below(3) == 0) return kEnds[random.Below(std::size(kEnds))];
  return static_cast<int64_t>(random.Bits()) >> random.Below(64);
}

std::vector<Deposit> AnyDeposits(TestRandom& random, PatchIndex places) {
  std::vector<Deposit> deposits;
  for (PatchIndex place = 0; place < places; ++place) {
    if (random.Below(2) == 0) continue;
    const int64_t hits = 1 + (random.Below((1ll << 32) - 1) >> random.Below(32));
    deposits.push_back({AnyNumber(random), AnyNumber(random), AnyNumber(random), hits, place});
  }
  return deposits;
}

// A result that can be written, true or not.
UnitResult AnyResult(TestRandom& random) {
  UnitResult result;
  result.deposits = AnyDeposits(random, kPatches);
  result.rests = AnyDeposits(random, 2 * kPatches);
  for (int64_t k = random.Below(30); k > 0; --k) {
    result.sightings.push_back({static_cast<int32_t>(random.Below(kPatches)),
                                static_cast<int32_t>(random.Below(65536)),
                                static_cast<PatchIndex>(random.Below(kPatches)),
                                static_cast<int32_t>(1 + random.Below(kManyTimes))});
  }
  CombineSightings(result.sightings);
  for (int c = 0; c < 3; ++c) {
    result.shot[c] = AnyNumber(random);
    result.escaped[c] = AnyNumber(random);
  }
  result.rays = AnyNumber(random);
  result.cpu_seconds = static_cast<double>(random.Below(1 << 20));  // sums exactly
  return result;
}

UnitResult AnyResult() {
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  return AnyResult(random);
}

RC_GTEST_PROP(MergeResult, IsAssociativeAndCommutativeOfAnyNumbers, ()) {
  const UnitResult a = AnyResult(), b = AnyResult(), c = AnyResult();
  RC_ASSERT(Merged(a, b) == Merged(b, a));
  RC_ASSERT(Merged(Merged(a, b), c) == Merged(a, Merged(b, c)));
}

RC_GTEST_PROP(MergeResult, OfNothingChangesNothing, ()) {
  const UnitResult a = AnyResult();
  RC_ASSERT(Merged(a, {}) == a);
  RC_ASSERT(Merged({}, a) == a);
}

RC_GTEST_PROP(UnitCodec, GivesAnyResultBackButForTheProcessorTime, ()) {
  UnitResult result = AnyResult();
  const std::string bytes = EncodeUnitResult(result);
  const absl::StatusOr<UnitResult> read = DecodeUnitResult(bytes, kPatches);
  RC_ASSERT(read.ok());
  RC_ASSERT(EncodeUnitResult(*read) == bytes);
  result.cpu_seconds = 0;
  RC_ASSERT(*read == result);
}

RC_GTEST_PROP(UnitCodec, GivesAnyUnitBack, ()) {
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  WorkUnit unit{random.Bits(), static_cast<uint32_t>(random.Bits()), 5, {}};
  unit.rays_per_m2 = random.Uniform(0, 1e300);
  for (int64_t k = random.Below(20); k > 0; --k) {
    Visit visit{static_cast<PatchIndex>(random.Bits()),
                static_cast<uint32_t>(random.Bits()),
                static_cast<uint32_t>(random.Bits()),
                static_cast<uint32_t>(random.Bits()),
                {AnyNumber(random), AnyNumber(random), AnyNumber(random)}};
    visit.seen.assign(random.Below(100), static_cast<uint32_t>(random.Bits()));
    unit.visits.push_back(visit);
  }
  const absl::StatusOr<WorkUnit> read = DecodeUnit(EncodeUnit(unit));
  RC_ASSERT(read.ok());
  RC_ASSERT(*read == unit);
}

// A unit and what an honest worker returns for it.
struct Booked {
  WorkUnit unit;
  UnitResult result;
};
Booked AnyBooked(bool refined) {
  const auto rays = *LandedRays(kPatches, 1 << 20);
  Booked booked;
  booked.unit.rays_per_m2 = refined ? 2.5 : 0;
  const auto count = static_cast<uint32_t>(rays.size());
  booked.unit.visits = {{0, count, 0, count, {}}};
  booked.result = ResultOf(rays, refined);
  return booked;
}

// Every number of flux that a result holds, in places of the channels r, g, b.
std::vector<int64_t*> NumbersOfFlux(UnitResult& result) {
  std::vector<int64_t*> numbers = {&result.rays};
  for (int c = 0; c < 3; ++c) {
    numbers.push_back(&result.shot[c]);
    numbers.push_back(&result.escaped[c]);
  }
  for (auto* deposits : {&result.deposits, &result.rests}) {
    for (Deposit& d : *deposits) numbers.insert(numbers.end(), {&d.r, &d.g, &d.b});
  }
  return numbers;
}

RC_GTEST_PROP(CheckLedger, AcceptsHonestResultsAndWhatTheyMergeTo, ()) {
  const bool refined = *rc::gen::arbitrary<bool>();
  const Booked a = AnyBooked(refined), b = AnyBooked(refined);
  RC_ASSERT(CheckLedger(a.unit, a.result).ok());
  WorkUnit both = a.unit;
  both.visits.push_back(b.unit.visits[0]);
  RC_ASSERT(CheckLedger(both, Merged(a.result, b.result)).ok());
}

RC_GTEST_PROP(CheckLedger, NoticesAnyChangeOfAnyOneNumberOfFlux, ()) {
  Booked booked = AnyBooked(*rc::gen::arbitrary<bool>());
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  for (int64_t* number : NumbersOfFlux(booked.result)) {
    const int64_t was = *number;
    for (int64_t now : {was + 1, was - 1, -was, was / 2, AnyNumber(random), AnyNumber(random)}) {
      if (now == was) continue;
      *number = now;
      const absl::Status status = CheckLedger(booked.unit, booked.result);
      RC_ASSERT(status.code() == absl::StatusCode::kDataLoss);
      RC_ASSERT(ReasonOf(status) == "RESULT_INVALID");
    }
    *number = was;
  }
}

RC_GTEST_PROP(CheckLedger, NoticesALostDepositAndOneThatIsThereTwice, ()) {
  Booked booked = AnyBooked(*rc::gen::arbitrary<bool>());
  for (auto* deposits : {&booked.result.deposits, &booked.result.rests}) {
    const std::vector<Deposit> all = *deposits;
    for (size_t k = 0; k < all.size(); ++k) {
      if (all[k].r == 0 && all[k].g == 0 && all[k].b == 0) continue;  // says nothing of flux
      *deposits = all;
      deposits->erase(deposits->begin() + static_cast<std::ptrdiff_t>(k));
      RC_ASSERT(!CheckLedger(booked.unit, booked.result).ok());
      *deposits = all;
      deposits->push_back(all[k]);
      RC_ASSERT(!CheckLedger(booked.unit, booked.result).ok());
    }
    *deposits = all;
  }
}

// Of hits, as far as it can be told: no more arrive than were shot, at least one with each deposit,
// and not all where flux has escaped; with places of rest, each once.
RC_GTEST_PROP(CheckLedger, NoticesHitsThatCannotBe, ()) {
  const bool refined = *rc::gen::arbitrary<bool>();
  Booked booked = AnyBooked(refined);
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  int64_t hits = 0;
  for (const Deposit& d : booked.result.deposits) hits += d.hits;
  for (Deposit& d : booked.result.deposits) {
    const int64_t was = d.hits, room = booked.result.rays - hits;
    for (int64_t now : {int64_t{0}, -was, was + room + 1, std::numeric_limits<int64_t>::max()}) {
      d.hits = now;
      RC_ASSERT(!CheckLedger(booked.unit, booked.result).ok());
    }
    d.hits = was + room;
    const bool none_escaped = booked.result.escaped == Quanta{};
    RC_ASSERT(CheckLedger(booked.unit, booked.result).ok() ==
              (room == 0 || (none_escaped && !refined)));
    d.hits = was;
  }
}

}  // namespace
}  // namespace lambert
