#include "tests/support/stub_shooter.h"

#include <algorithm>
#include <map>

namespace lambert {
namespace {

// Takes neighbours far apart.
constexpr int64_t kStride = 7919;

class StubShooter : public Shooter {
 public:
  explicit StubShooter(PatchIndex patches) : patches_(patches) {}

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override {
    UnitResult result;
    result.channels = unit.channels;
    result.rays = unit.RayCount();
    std::map<PatchIndex, Deposit> deposits;
    for (const Visit& visit : unit.visits) {
      const auto patch = static_cast<PatchIndex>((visit.emitter + 1) * kStride % patches_);
      Deposit& deposit = deposits[patch];
      deposit.patch = patch;
      deposit.hits += visit.ray_end - visit.ray_begin;
      const Quanta shot = Dealt(visit);
      deposit.r += shot[0];
      deposit.g += shot[1];
      deposit.b += shot[2];
      for (int c = 0; c < 3; ++c) result.shot[c] += shot[c];
    }
    for (const auto& [patch, deposit] : deposits) result.deposits.push_back(deposit);
    return result;
  }

 private:
  // What the rays of a visit carry: the quotient each, and the first one more.
  static Quanta Dealt(const Visit& visit) {
    Quanta dealt{};
    for (int c = 0; c < 3; ++c) {
      const int64_t quotient = visit.quanta[c] / visit.ray_count;
      const int64_t remainder = visit.quanta[c] % visit.ray_count;
      dealt[c] = quotient * (visit.ray_end - visit.ray_begin) +
                 std::min<int64_t>(visit.ray_end, remainder) -
                 std::min<int64_t>(visit.ray_begin, remainder);
    }
    return dealt;
  }

  const int64_t patches_;
};

}  // namespace

absl::StatusOr<std::shared_ptr<const Shooter>> MakeStubShooter(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
  return std::make_shared<const StubShooter>(patches->size());
}

}  // namespace lambert
