#include "radiosity/patch/box_pairs.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <utility>

namespace lambert {
namespace {

using Pairs = std::multiset<std::pair<size_t, size_t>>;

Pairs Found(const std::vector<Bounds>& boxes, double slack) {
  Pairs pairs;
  ForEachMeetingPair(boxes, slack, [&](size_t i, size_t j) { pairs.emplace(i, j); });
  return pairs;
}

TEST(ForEachMeetingPair, VisitsEveryPairOnceThatASearchOfAllFinds) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> where(0, 1), size(0, 0.3);
  for (size_t count : {0, 1, 2, 3, 64, 100}) {
    std::vector<Bounds> boxes;
    for (size_t k = 0; k < count; ++k) {
      const Vec3 low{where(random), where(random), where(random)};
      boxes.push_back({low, low + Vec3{size(random), size(random), size(random)}});
    }
    for (double slack : {0.0, 0.1}) {
      const auto near = [slack](double low_a, double high_a, double low_b, double high_b) {
        return low_a <= high_b + slack && low_b <= high_a + slack;
      };
      Pairs expected;
      for (size_t j = 0; j < count; ++j) {
        for (size_t i = 0; i < j; ++i) {
          const auto& [p, q] = boxes[i];
          const auto& [r, s] = boxes[j];
          if (near(p.x, q.x, r.x, s.x) && near(p.y, q.y, r.y, s.y) && near(p.z, q.z, r.z, s.z)) {
            expected.emplace(i, j);
          }
        }
      }
      EXPECT_EQ(Found(boxes, slack), expected) << count;
    }
  }
}

}  // namespace
}  // namespace lambert
