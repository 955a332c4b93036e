#include "tests/analytic/stiff_case.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lambert {
namespace {

Value Power(const PatchSet& patches, int channel) {
  return [&patches, channel](const Solution& s) {
    double power = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      power += patches.area_m2[i] * s.radiosity_lm_per_m2[i][channel];
    }
    return power;
  };
}

}  // namespace

void ExpectValue(const StiffCase& c, const Value& value, double truth, double least) {
  const auto limit = [&](const Estimate& e) { return 4 * e.std_error + least; };
  Estimate found = Over(c.solutions, value);
  if (std::abs(found.mean - truth) > limit(found)) {
    found = Over(SolveSeeds(c.patches, c.options, 64, 1000), value);
  }
  EXPECT_NEAR(found.mean, truth, limit(found));
}

void ExpectPower(const StiffCase& c, int channel, double truth, double allowed) {
  ExpectValue(c, Power(c.patches, channel), truth, (allowed + 1e-6) * truth);
}

void ExpectUniform(const StiffCase& c, int channel, double ratio) {
  double z2 = 0;
  int count = 0;
  double power = 0;
  for (PatchIndex i = 0; i < c.patches.size(); ++i) {
    const double truth = ratio * c.patches.exitance_lm_per_m2[i][channel];
    power += truth * c.patches.area_m2[i];
    int64_t hits = 0;
    for (const Solution& s : c.solutions) hits += s.hits[i];
    if (hits < 400) continue;
    const Estimate b =
        Over(c.solutions, [&](const Solution& s) { return s.radiosity_lm_per_m2[i][channel]; });
    if (!(b.std_error > 0)) continue;
    z2 += std::pow((b.mean - truth) / b.std_error, 2);
    ++count;
  }
  ExpectPower(c, channel, power, 0);
  // Student's t with 7 degrees of freedom has variance 7/5 and z^2 a fourth moment that spreads the
  // mean of a few patches widely.
  if (count > 0) {
    EXPECT_LT(z2 / count, 1.4 * (1 + 6 / std::sqrt(count)));
  }
}

void ExpectRadiosity(const StiffCase& c, const std::vector<PatchIndex>& of, double exitance,
                     double truth) {
  double area = 0;
  for (PatchIndex i : of) area += c.patches.area_m2[i];
  const Value mean = [&](const Solution& s) {
    double power = 0;
    for (PatchIndex i : of) power += c.patches.area_m2[i] * s.radiosity_lm_per_m2[i].r;
    return power / area / exitance;
  };
  if (truth == 0) {
    for (const Solution& s : c.solutions) EXPECT_EQ(mean(s), 0);
    return;
  }
  // Where few rays miss, all may hit: then the mean is off by one of them.
  ExpectValue(
      c, mean, truth,
      1e-6 * truth + EmittedFlux(c.patches).r / (kStiffRays * kStiffSeeds) / area / exitance);
}

}  // namespace lambert
