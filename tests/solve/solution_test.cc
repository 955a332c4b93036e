#include "radiosity/solve/solution.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

Solution MakeSolution() {
  Solution solution;
  for (int i = 0; i < 17; ++i) {
    const double x = i + 0.1;
    solution.radiosity_lm_per_m2.push_back({x, 2 * x, 3 * x});
    solution.irradiance_lx.push_back({4 * x, 5 * x, 6 * x});
    solution.std_error_lm_per_m2.push_back({7 * x, 8 * x, 9 * x});
    solution.hits.push_back(int64_t{1} << i);
  }
  solution.ledger.emitted = {1, 2, 3};
  solution.ledger.absorbed = {4, 5, 6};
  solution.ledger.escaped = {7, 8, 9};
  solution.ledger.unsent = {10, 11, 12};
  solution.ledger.residual = {-1, -2, -3};
  return solution;
}

TEST(SolutionCodec, GivesEveryFieldBack) {
  const Solution solution = MakeSolution();
  const std::string bytes = EncodeSolution(solution);
  const absl::StatusOr<Solution> read = DecodeSolution(bytes);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->radiosity_lm_per_m2, solution.radiosity_lm_per_m2);
  EXPECT_EQ(read->irradiance_lx, solution.irradiance_lx);
  EXPECT_EQ(read->std_error_lm_per_m2, solution.std_error_lm_per_m2);
  EXPECT_EQ(read->hits, solution.hits);
  EXPECT_EQ(read->ledger.emitted, solution.ledger.emitted);
  EXPECT_EQ(read->ledger.absorbed, solution.ledger.absorbed);
  EXPECT_EQ(read->ledger.escaped, solution.ledger.escaped);
  EXPECT_EQ(read->ledger.unsent, solution.ledger.unsent);
  EXPECT_EQ(read->ledger.residual, solution.ledger.residual);
  EXPECT_TRUE(EncodeSolution(*read) == bytes);
}

TEST(SolutionCodec, TakesASolutionOfNoPatches) {
  EXPECT_TRUE(DecodeSolution(EncodeSolution(Solution())).ok());
}

TEST(SolutionCodec, RefusesEveryTruncationAndWhatFollowsTheEnd) {
  const std::string bytes = EncodeSolution(MakeSolution());
  for (size_t size = 0; size < bytes.size(); ++size) {
    const absl::StatusOr<Solution> read = DecodeSolution(bytes.substr(0, size));
    ASSERT_EQ(read.status().code(), absl::StatusCode::kDataLoss) << size;
    ASSERT_EQ(ReasonOf(read.status()), "SOLUTION_INVALID");
  }
  EXPECT_FALSE(DecodeSolution(bytes + '\0').ok());
}

TEST(SolutionCodec, DamagedBytesAreRefusedOrDecodeToAsManyPatches) {
  TestRandom random(1);
  const std::string bytes = EncodeSolution(MakeSolution());
  int refused = 0;
  for (int k = 0; k < 10000; ++k) {
    std::string damaged = bytes;
    damaged[random.Below(static_cast<int64_t>(k % 2 == 0 ? 16 : bytes.size()))] ^=
        static_cast<char>(1 + random.Below(255));
    const absl::StatusOr<Solution> read = DecodeSolution(damaged);
    if (read.ok()) {
      ASSERT_EQ(read->hits.size(), 17u);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace lambert
