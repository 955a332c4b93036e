// What counts as clear is seen by every segment, and what is hidden is not clear.
#include "radiosity/exact/occluders.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/exact/exchange.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr int kSegments = 8;

// Visible segments of `kSegments` between two parts.
int Seen(const Facing& facing, SegmentTracer& tracer) {
  const Segments segments(facing);
  for (int k = 0; k < kSegments; ++k) {
    const Segments::Segment s = segments.Sample({0.1f, 0.3f, 0.5f, 0.7f}, k);
    tracer.Add(s.from, segments.from_normal(), s.to, segments.to_normal());
  }
  int seen = 0;
  tracer.Land([&](int, bool is_visible) { seen += is_visible; });
  return seen;
}

TEST(Occluders, ClearPairsSeeEachOtherWhole) {
  for (const Scene& scene : {MakeOffice(1), MakeCornell(2)}) {
    const PatchSet patches = PatchesOf(scene);
    const Occluders occluders(patches);
    const auto rays = *RayScene::Create(patches);
    SegmentTracer tracer(*rays);
    int64_t clear = 0, unclear = 0, whole = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      for (PatchIndex j = i + 1; j < patches.size(); ++j) {
        const Facing facing = FacingParts(patches.corners[i], patches.corners[j]);
        if (facing.empty()) continue;
        const int seen = Seen(facing, tracer);
        if (occluders.SurelyClear(facing.from, facing.to)) {
          EXPECT_EQ(seen, kSegments) << i << " and " << j;
          ++clear;
        } else {
          ++unclear;
          whole += seen == kSegments;
        }
      }
    }
    EXPECT_GT(2 * clear, unclear);
    EXPECT_LT(whole, unclear / 2);  // few are doubted without a reason
  }
}

TEST(Occluders, AConvexRoomHasNone) {
  EXPECT_EQ(Occluders(PatchesOf(MakeFurnace(0.5, 1, 4))).size(), 0);
  EXPECT_EQ(Occluders(PatchesOf(MakeIcosphere(2, {{}, {}, false}))).size(), 0);
}

TEST(Exchange, SamplesWithoutBias) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  const auto rays = *RayScene::Create(patches);
  const Exchange exchange(patches, *rays);
  ASSERT_GT(exchange.links().size(), 100u);
  // Few rays, so that most links get one only by chance; many, as the truth.
  const auto sum = [&](int64_t count, uint64_t seed) {
    const std::vector<double> weights(exchange.links().size(), 1);
    const Transport transport = exchange.Sample(weights, count, seed, 0);
    double total = 0;
    for (const Link& link : exchange.links()) total += transport.exchange.at(link.i, link.j);
    return total;
  };
  const double truth = sum(5'000'000, 1);
  const int64_t few = static_cast<int64_t>(exchange.links().size()) / 2;
  constexpr int kSeeds = 200;
  double mean = 0, squares = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double d = sum(few, 100 + seed) - truth;
    mean += d / kSeeds;
    squares += d * d / kSeeds;
  }
  EXPECT_LT(std::fabs(mean), 4 * std::sqrt(squares / kSeeds));
}

}  // namespace
}  // namespace lambert
