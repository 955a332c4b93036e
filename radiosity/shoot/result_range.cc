#include "radiosity/shoot/result_range.h"

#include <algorithm>

namespace lambert {
namespace {

// The part of a sorted list whose key is in [begin, end).
template <typename T, typename Key>
std::vector<T> Between(const std::vector<T>& list, int64_t begin, int64_t end, const Key& key) {
  const auto is_before = [&key](const T& element, int64_t bound) { return key(element) < bound; };
  const auto first = std::lower_bound(list.begin(), list.end(), begin, is_before);
  return {first, std::lower_bound(first, list.end(), end, is_before)};
}

int64_t PlaceOf(const Deposit& deposit) { return deposit.patch; }
int64_t EmitterOf(const Sighting& sighting) { return sighting.emitter; }

template <typename T, typename Key>
bool IsBetween(const std::vector<T>& list, int64_t begin, int64_t end, const Key& key) {
  return list.empty() || (key(list.front()) >= begin && key(list.back()) < end);
}

template <typename T>
void Append(const std::vector<T>& from, std::vector<T>& into) {
  into.insert(into.end(), from.begin(), from.end());
}

}  // namespace

UnitResult RangeOf(const UnitResult& result, PatchIndex begin, PatchIndex end) {
  UnitResult range;
  range.deposits = Between(result.deposits, begin, end, PlaceOf);
  range.rests = Between(result.rests, 2 * int64_t{begin}, 2 * int64_t{end}, PlaceOf);
  range.sightings = Between(result.sightings, begin, end, EmitterOf);
  range.channels = result.channels;
  return range;
}

UnitResult LedgerOf(const UnitResult& result) {
  UnitResult ledger;
  ledger.shot = result.shot;
  ledger.escaped = result.escaped;
  ledger.rays = result.rays;
  ledger.channels = result.channels;
  ledger.cpu_seconds = result.cpu_seconds;
  return ledger;
}

bool IsRange(const UnitResult& result, PatchIndex begin, PatchIndex end) {
  return result.rays == 0 && result.shot == Quanta{} && result.escaped == Quanta{} &&
         IsBetween(result.deposits, begin, end, PlaceOf) &&
         IsBetween(result.rests, 2 * int64_t{begin}, 2 * int64_t{end}, PlaceOf) &&
         IsBetween(result.sightings, begin, end, EmitterOf);
}

void AppendRange(const UnitResult& range, UnitResult& into) {
  Append(range.deposits, into.deposits);
  Append(range.rests, into.rests);
  Append(range.sightings, into.sightings);
}

}  // namespace lambert
