#include "radiosity/shoot/arrivals.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

// Rays in random order, and what they sum to, by patch. Few of many patches are hit, or most.
void ExpectSums(PatchIndex patches, int rays, Arrivals& arrivals) {
  TestRandom random(static_cast<uint64_t>(rays));
  std::vector<Deposit> sums(patches);
  for (int k = 0; k < rays; ++k) {
    const auto patch = static_cast<PatchIndex>(random.Below(patches));
    const int64_t r = random.Below(100), g = random.Below(100), b = random.Below(100);
    arrivals.Prefetch(patch);
    arrivals.Add(patch, r, g, b);
    Deposit& sum = sums[patch];
    sum = {sum.r + r, sum.g + g, sum.b + b, sum.hits + 1, patch};
  }
  std::vector<Deposit> expected;
  for (const Deposit& sum : sums) {
    if (sum.hits > 0) expected.push_back(sum);
  }
  EXPECT_EQ(arrivals.Take(), expected) << rays << " rays";
}

TEST(Arrivals, ListTheSumsOfThePatchesThatWereHitInOrder) {
  Arrivals arrivals(1000);
  for (int rays : {0, 1, 30, 124, 126, 1000, 20000}) ExpectSums(1000, rays, arrivals);
}

TEST(Arrivals, OfGrayLightKeepTheFirstChannelAndTheHits) {
  Arrivals arrivals(300, kGrayChannels);
  arrivals.Prefetch(299);
  arrivals.Add(299, 7, 0, 0);
  arrivals.Add(2, 1, 0, 0);
  arrivals.Add(299, 8, 0, 0);
  EXPECT_EQ(arrivals.Take(), (std::vector<Deposit>{{1, 0, 0, 1, 2}, {15, 0, 0, 2, 299}}));
  EXPECT_TRUE(arrivals.Take().empty());
}

TEST(Arrivals, AreEmptyAfterTheyWereTaken) {
  Arrivals arrivals(16);
  arrivals.Add(5, 1, 2, 3);
  arrivals.Add(5, 1, 0, 0);
  EXPECT_EQ(arrivals.Take(), (std::vector<Deposit>{{2, 2, 3, 2, 5}}));
  EXPECT_TRUE(arrivals.Take().empty());
  arrivals.Add(5, 0, 0, 1);
  EXPECT_EQ(arrivals.Take(), (std::vector<Deposit>{{0, 0, 1, 1, 5}}));
}

TEST(Arrivals, OfARayWithoutFluxCountAsAHit) {
  Arrivals arrivals(4);
  arrivals.Add(3, 0, 0, 0);
  EXPECT_EQ(arrivals.Take(), (std::vector<Deposit>{{0, 0, 0, 1, 3}}));
}

TEST(ArrivalsPool, LendsWhatWasReturnedAndNeverTheSameTwiceAtOnce) {
  ArrivalsPool pool(10, kColorChannels);
  std::unique_ptr<Arrivals> a = pool.Borrow(), b = pool.Borrow();
  EXPECT_NE(a, b);
  const std::set<Arrivals*> made = {a.get(), b.get()};
  pool.Return(std::move(a));
  pool.Return(std::move(b));
  a = pool.Borrow();
  b = pool.Borrow();
  EXPECT_EQ((std::set<Arrivals*>{a.get(), b.get()}), made);
}

TEST(ArrivalsPool, ServesThreadsAtOnce) {
  ArrivalsPool pool(100, kColorChannels);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&pool] {
      for (int rays = 1; rays < 100; ++rays) {
        std::unique_ptr<Arrivals> arrivals = pool.Borrow();
        ExpectSums(100, rays, *arrivals);
        pool.Return(std::move(arrivals));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace lambert
