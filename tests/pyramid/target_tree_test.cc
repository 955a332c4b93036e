#include "radiosity/pyramid/target_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "radiosity/pyramid/concentric_grid.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// In a closed convex box nothing is occluded: the moments of worth 1 are the flux fractions.
TEST(TargetTree, MomentsOfEqualWorthInAClosedBoxAreTheFluxFractions) {
  const PatchSet patches = PatchesOf(MakeBox(6, {0.5, 0.5, 0.5}, std::vector<Rgb>(6)));
  const TargetTree tree(patches, std::vector<double>(patches.size(), 1));
  const ConcentricGrid cells(4);
  for (PatchIndex i = 0; i < patches.size(); i += 13) {
    const std::vector<double> moments = tree.Moments(PatchFrame(patches, i), cells, 0.05);
    EXPECT_NEAR(std::accumulate(moments.begin(), moments.end(), 0.0), 1, 0.03) << i;
    for (double m : moments) EXPECT_NEAR(m * 16, 1, 0.35) << i;
  }
}

TEST(TargetTree, MomentsAreProportionalToTheWorthAndOfNoWorthZero) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  std::vector<double> worth(patches.size(), 2);
  const ConcentricGrid cells(8);
  const TargetTree two(patches, worth), six(patches, std::vector<double>(patches.size(), 6));
  const TargetTree none(patches, std::vector<double>(patches.size(), 0));
  for (PatchIndex i = 0; i < patches.size(); i += 37) {
    const LocalFrame frame = PatchFrame(patches, i);
    const std::vector<double> a = two.Moments(frame, cells, 0.2),
                              b = six.Moments(frame, cells, 0.2);
    for (int p = 0; p < 64; ++p) EXPECT_NEAR(3 * a[p], b[p], 1e-12 * (1 + b[p]));
    EXPECT_EQ(none.Moments(frame, cells, 0.2), std::vector<double>(64, 0.0));
  }
}

// A coarse opening sees nearly what a fine one sees.
TEST(TargetTree, BulkIsNearTheSumOverPatches) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const TargetTree tree(patches, std::vector<double>(patches.size(), 1));
  const ConcentricGrid cells(4);
  double difference = 0, total = 0;
  for (PatchIndex i = 0; i < patches.size(); i += 97) {
    const LocalFrame frame = PatchFrame(patches, i);
    const std::vector<double> fine = tree.Moments(frame, cells, 0.02);
    const std::vector<double> coarse = tree.Moments(frame, cells, 0.2);
    for (int p = 0; p < cells.size(); ++p) {
      difference += std::abs(fine[p] - coarse[p]);
      total += fine[p];
    }
  }
  EXPECT_LT(difference / total, 0.15);
}

}  // namespace
}  // namespace lambert
