#include "radiosity/gather/gather_units.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/gather/gather.h"
#include "radiosity/shoot/this_thread.h"

namespace lambert {
namespace {

constexpr size_t kRaysPerUnit = 1 << 14;
constexpr int64_t kInfinityBits = 0x7F800000;  // float32 numbers >= 0 lie below

uint32_t Values(size_t points) { return 2 * static_cast<uint32_t>(points); }

Deposit MakeDeposit(PatchIndex value, Rgb rgb) {
  const auto bits = [](double x) { return std::bit_cast<int32_t>(TravellingFloat(x)); };
  return {bits(rgb.r), bits(rgb.g), bits(rgb.b), 1, value};
}

class GatherShooter : public Shooter {
 public:
  GatherShooter(std::shared_ptr<const Gatherer> gatherer, GatherPoints points, uint32_t first_name)
      : gatherer_(std::move(gatherer)), points_(std::move(points)), first_name_(first_name) {}

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override {
    const double start = ThreadCpuSeconds();
    UnitResult result;
    for (const Visit& visit : unit.visits) {
      if (visit.ray_count != Values(points_.size()) || visit.ray_begin > visit.ray_end ||
          visit.ray_end > visit.ray_count || visit.ray_begin % 2 != 0 || visit.ray_end % 2 != 0 ||
          unit.channels != kColorChannels) {
        return MakeError(absl::StatusCode::kInvalidArgument,
                         {"FIELD_INVALID", "work unit", "it is not about these points",
                          "use programs of one version"});
      }
      const size_t begin = visit.ray_begin / 2;
      const Gathered gathered = gatherer_->Run(points_, begin, visit.ray_end / 2, first_name_);
      for (size_t i = 0; i < gathered.irradiance_lx.size(); ++i) {
        const auto value = static_cast<PatchIndex>(2 * (begin + i));
        Add(MakeDeposit(value, gathered.irradiance_lx[i]), result);
        Add(MakeDeposit(value + 1, gathered.std_error_lx[i]), result);
      }
    }
    result.cpu_seconds = ThreadCpuSeconds() - start;
    return result;
  }

 private:
  static void Add(const Deposit& deposit, UnitResult& result) {
    result.deposits.push_back(deposit);
    for (int c = 0; c < 3; ++c) result.shot[c] += deposit.quanta()[c];
    ++result.rays;
  }

  const std::shared_ptr<const Gatherer> gatherer_;
  const GatherPoints points_;
  const uint32_t first_name_;
};

}  // namespace

std::vector<WorkUnit> CutGather(size_t points, int rays_per_point) {
  const size_t step = std::max<size_t>(1, kRaysPerUnit / (2 * static_cast<size_t>(rays_per_point)));
  std::vector<WorkUnit> units;
  for (size_t begin = 0; begin < points; begin += step) {
    const size_t end = std::min(begin + step, points);
    units.emplace_back();
    units.back().visits = {{0, Values(points), Values(begin), Values(end), {}}};
  }
  return units;
}

absl::StatusOr<Gathered> GatheredOf(const UnitResult& result, size_t points) {
  const auto invalid = [] {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"RESULT_INVALID", "gathered values", "a point is missing or has no number",
                      "check the workers' machines"});
  };
  if (result.deposits.size() != Values(points)) return invalid();
  Gathered gathered;
  for (const Deposit& deposit : result.deposits) {
    Rgb value;
    for (int c = 0; c < 3; ++c) {
      const int64_t bits = deposit.quanta()[c];
      if (bits < 0 || bits >= kInfinityBits || deposit.hits != 1) return invalid();
      value[c] = std::bit_cast<float>(static_cast<int32_t>(bits));
    }
    (deposit.patch % 2 == 0 ? gathered.irradiance_lx : gathered.std_error_lx).push_back(value);
  }
  return gathered;
}

absl::StatusOr<std::shared_ptr<const Shooter>> MakeGatherShooter(
    std::shared_ptr<const PatchSet> patches, const GatherTask& task) {
  if (task.radiosity_lm_per_m2.size() != patches->corners.size()) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"GATHER_INVALID", "gather task", "it is not about these patches",
                      "use programs of one version"});
  }
  auto gatherer = Gatherer::Create(std::move(patches), task.radiosity_lm_per_m2, task.options);
  if (!gatherer.ok()) return gatherer.status();
  return std::make_shared<const GatherShooter>(*std::move(gatherer), task.points, task.first_name);
}

}  // namespace lambert
