// CheckLedger: what can be noticed of a result without computing it again.
#include <array>
#include <string>

#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"
#include "radiosity/shoot/unit.h"

namespace lambert {
namespace {

absl::Status Unsound(const std::string& why) {
  return MakeError(absl::StatusCode::kDataLoss,
                   {"RESULT_INVALID", "unit result", why, "use programs of one version"});
}

// 128 bits: a forged result must not pass by overflowing.
struct Total {
  std::array<__int128, 3> quanta{};
  __int128 hits = 0;
  bool operator==(const Total&) const = default;
};

absl::StatusOr<Total> TotalOf(const std::vector<Deposit>& deposits) {
  Total sum;
  for (const Deposit& deposit : deposits) {
    if (deposit.r < 0 || deposit.g < 0 || deposit.b < 0) {
      return Unsound("a deposit is negative");
    }
    if (deposit.hits <= 0) return Unsound("flux arrived without a ray");
    sum.quanta[0] += deposit.r;
    sum.quanta[1] += deposit.g;
    sum.quanta[2] += deposit.b;
    sum.hits += deposit.hits;
  }
  return sum;
}

}  // namespace

absl::Status CheckLedger(const WorkUnit& unit, const UnitResult& result) {
  return CheckLedger(unit, unit.RayCount(), result);
}

absl::Status CheckLedger(const WorkUnit& any, int64_t rays, const UnitResult& result) {
  if (result.channels != any.channels) {
    return Unsound("it has " + std::to_string(result.channels) + " channels of " +
                   std::to_string(any.channels));
  }
  if (!any.MayHaveShot(rays, result.rays)) {
    return Unsound("it reports " + std::to_string(result.rays) + " rays of " +
                   std::to_string(rays));
  }
  const absl::StatusOr<Total> total = TotalOf(result.deposits);
  if (!total.ok()) return total.status();
  const auto& [arrived, hits] = *total;
  const absl::StatusOr<Total> rested = TotalOf(result.rests);
  if (!rested.ok()) return rested.status();
  if (*rested != (any.rays_per_m2 > 0 ? *total : Total{})) {
    return Unsound("what came to rest is not what arrived");
  }
  if (hits > result.rays) return Unsound("more rays arrived than were shot");
  if (result.sightings.size() > static_cast<size_t>(hits)) {
    return Unsound("more was seen than rays arrived");
  }
  for (int c = 0; c < 3; ++c) {
    if (hits == result.rays && result.escaped[c] != 0) {
      return Unsound("flux is missing although every ray arrived");
    }
    if (result.escaped[c] < 0 || arrived[c] + result.escaped[c] != result.shot[c]) {
      return Unsound("the ledger of channel " + std::to_string(c) + " does not balance: shot " +
                     std::to_string(result.shot[c]) + ", arrived " +
                     std::to_string(static_cast<int64_t>(arrived[c])) + ", escaped " +
                     std::to_string(result.escaped[c]));
    }
  }
  return absl::OkStatus();
}

}  // namespace lambert
