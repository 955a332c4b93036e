#include "radiosity/solve/options.h"

#include <gtest/gtest.h>

#include <limits>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Change>
std::string RefusedAfter(Change change) {
  SolveOptions options;
  change(options);
  const absl::Status status = options.Validate();
  if (status.ok()) return "";
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(ReasonOf(status), "FIELD_INVALID");
  return GetErrorDetail(status)->where;
}

TEST(SolveOptions, DefaultsAreValid) {
  EXPECT_EQ(RefusedAfter([](SolveOptions&) {}), "");
}

TEST(SolveOptions, ValidationNamesTheFieldThatIsOutOfRange) {
  for (double bad : {-1.0, kNan, kInfinity}) {
    EXPECT_EQ(RefusedAfter([&](SolveOptions& o) { o.max_error = bad; }), "max-error");
    EXPECT_EQ(RefusedAfter([&](SolveOptions& o) { o.max_time_s = bad; }), "max-time");
    EXPECT_EQ(RefusedAfter([&](SolveOptions& o) { o.unsent_tolerance = bad; }), "unsent-tolerance");
  }
  EXPECT_EQ(RefusedAfter([](SolveOptions& o) { o.unsent_tolerance = 1; }), "unsent-tolerance");
  EXPECT_EQ(RefusedAfter([](SolveOptions& o) { o.max_rays = -1; }), "max-rays");
  EXPECT_EQ(RefusedAfter([](SolveOptions& o) { o.max_steps = 0; }), "max-steps");
  EXPECT_EQ(RefusedAfter([](SolveOptions& o) { o.shoot.pyramids.split = 7; }), "phs-split");
}

}  // namespace
}  // namespace lambert
