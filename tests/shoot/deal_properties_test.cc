#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/shoot/flight.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr int64_t kMost = std::numeric_limits<int64_t>::max();

// Quanta of any size, up to all that an int64 holds.
int64_t AnyQuanta() { return *rc::gen::inRange(int64_t{0}, kMost) >> *rc::gen::inRange(0, 63); }

RC_GTEST_PROP(RayDeal, GivesAllQuantaAwayAndNoTwoRaysDifferByMoreThanOne, ()) {
  const auto rays = *rc::gen::inRange<uint32_t>(1, 1000);
  const Quanta quanta{AnyQuanta(), AnyQuanta(), AnyQuanta()};
  const RayDeal deal(quanta, rays);
  Quanta sum{}, least = quanta, greatest{};
  for (uint32_t ray = 0; ray < rays; ++ray) {
    const Long4 flux = deal.Of(ray);
    RC_ASSERT(flux[3] == 1);
    for (int c = 0; c < 3; ++c) {
      sum[c] += flux[c];
      least[c] = std::min<int64_t>(least[c], flux[c]);
      greatest[c] = std::max<int64_t>(greatest[c], flux[c]);
    }
  }
  RC_ASSERT(sum == quanta);
  for (int c = 0; c < 3; ++c) RC_ASSERT(greatest[c] - least[c] <= 1);
}

// Of visits too long to be walked through: the rays before any ray share what is dealt to them.
RC_GTEST_PROP(RayDeal, GivesTheFirstRaysOneMoreAlsoOfBillions, ()) {
  const uint32_t rays = 1u + *rc::gen::arbitrary<uint32_t>() / 2;
  const Quanta quanta{AnyQuanta(), AnyQuanta(), AnyQuanta()};
  const RayDeal deal(quanta, rays);
  for (int c = 0; c < 3; ++c) {
    const int64_t more = quanta[c] % rays, each = quanta[c] / rays;
    RC_ASSERT(deal.Of(0)[c] == each + (more > 0));
    if (more > 0) RC_ASSERT(deal.Of(more - 1)[c] == each + 1);
    if (more < rays) RC_ASSERT(deal.Of(more)[c] == each);
    RC_ASSERT(deal.Of(rays - 1)[c] == each);
  }
}

// A cell's rays in ranges, as units cut them, get what they get in one go, and each what the mean
// says but for one quantum.
RC_GTEST_PROP(MeanDeal, DealsTheSameHoweverTheRaysAreCut, ()) {
  const auto rays = *rc::gen::inRange<uint32_t>(1, 500);
  TestRandom random(*rc::gen::arbitrary<uint32_t>());
  Double4 mean{};
  for (int c = 0; c < 3; ++c) {
    mean[c] = std::ldexp(random.Uniform(), *rc::gen::inRange(-20, kMaxQuantaBits)) / rays;
  }
  const Double4 rounding = mean * (rays * 0x1p-51);  // of the mean of all, on both sides
  MeanDeal whole(mean, 0);
  Quanta sum{};
  for (uint32_t begin = 0; begin < rays;) {
    const uint32_t end = std::min(rays, begin + 1 + static_cast<uint32_t>(random.Below(rays)));
    MeanDeal part(mean, begin);
    for (; begin < end; ++begin) {
      const Long4 expected = whole.Next(), flux = part.Next();
      for (int c = 0; c < 3; ++c) {
        RC_ASSERT(flux[c] == expected[c]);
        RC_ASSERT(flux[c] >= 0);
        RC_ASSERT(std::fabs(static_cast<double>(flux[c]) - mean[c]) <= 1 + rounding[c]);
        sum[c] += flux[c];
      }
    }
  }
  for (int c = 0; c < 3; ++c) {
    RC_ASSERT(std::fabs(static_cast<double>(sum[c]) - mean[c] * rays) <= 0.5 + rounding[c]);
  }
}

}  // namespace
}  // namespace lambert
