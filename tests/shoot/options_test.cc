#include "radiosity/shoot/options.h"

#include <gtest/gtest.h>

#include <limits>

#include "radiosity/core/error.h"
#include "radiosity/shoot/options_codec.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The field that validation names, or "" where it is content.
std::string Refused(const ShootOptions& options) {
  const absl::Status status = options.Validate();
  if (status.ok()) return "";
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(GetErrorDetail(status)->reason, "FIELD_INVALID");
  return GetErrorDetail(status)->where;
}

template <typename Change>
std::string RefusedAfter(Change change) {
  ShootOptions options;
  change(options.pyramids);
  return Refused(options);
}

TEST(ShootOptions, DefaultsAreValid) { EXPECT_EQ(Refused({}), ""); }

TEST(ShootOptions, ValidationNamesTheFieldThatIsOutOfRange) {
  for (int initial : {-1, 0, 2, 65}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.initial = initial; }), "phs-initial");
  }
  for (int split : {-4, 0, 2, 5}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.split = split; }), "phs-split");
  }
  for (int depth : {-1, 8, 1000, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.depth = depth; }), "phs-depth");
  }
  for (double alpha : {-0.1, kNan, kInfinity}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.alpha1 = alpha; }), "phs-alpha1, phs-alpha2");
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.alpha2 = alpha; }), "phs-alpha1, phs-alpha2");
  }
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.alpha1 = p.alpha2 = 0; }),
            "phs-alpha1, phs-alpha2");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.min_rays = -1; }), "phs-min-rays");
}

TEST(ShootOptions, ValidationTakesTheEndsOfEveryRange) {
  for (int initial : {3, 64}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.initial = initial; }), "");
  }
  for (int depth : {0, 4}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.depth = depth; }), "");
  }
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.split = 3; }), "");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.alpha1 = 0; }), "");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.alpha2 = 0; }), "");
}

TEST(ParseMethod, TurnsEveryNameBackIntoItsMethod) {
  for (Method method : {Method::kAuto, Method::kPmcr, Method::kPhs}) {
    EXPECT_EQ(*ParseMethod(MethodName(method)), method);
  }
}

TEST(ParseMethod, OfAnUnknownNameNamesTheChoices) {
  for (const char* name : {"", "PHS", "hs97"}) {
    const absl::StatusOr<Method> method = ParseMethod(name);
    ASSERT_FALSE(method.ok());
    const ErrorDetail detail = *GetErrorDetail(method.status());
    EXPECT_EQ(detail.reason, "FIELD_INVALID");
    EXPECT_EQ(detail.where, "method");
    EXPECT_NE(detail.message.find(name), std::string::npos);
    EXPECT_NE(detail.hint.find("auto, pmcr, phs"), std::string::npos) << detail.hint;
  }
}

ShootOptions UnusualOptions() {
  ShootOptions options;
  options.method = Method::kPhs;
  options.pyramids = {7, 3, 1, 0.25, 0.125, PyramidSampling::kSolidAngle, true, false, 12345};
  return options;
}

TEST(ShootOptionsCodec, GivesEveryFieldBack) {
  const std::string bytes = EncodeShootOptions(UnusualOptions());
  const absl::StatusOr<ShootOptions> read = DecodeShootOptions(bytes);
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_EQ(read->method, Method::kPhs);
  const PyramidOptions& p = read->pyramids;
  EXPECT_EQ(p.initial, 7);
  EXPECT_EQ(p.split, 3);
  EXPECT_EQ(p.depth, 1);
  EXPECT_EQ(p.alpha1, 0.25);
  EXPECT_EQ(p.alpha2, 0.125);
  EXPECT_EQ(p.sampling, PyramidSampling::kSolidAngle);
  EXPECT_TRUE(p.count_black);
  EXPECT_FALSE(p.use_clusters);
  EXPECT_EQ(p.min_rays, 12345);
  EXPECT_TRUE(EncodeShootOptions(*read) == bytes);
  EXPECT_FALSE(EncodeShootOptions({}) == bytes);
}

TEST(ShootOptionsCodec, RefusesWhatIsCutLongerOrOutOfRange) {
  const std::string bytes = EncodeShootOptions(UnusualOptions());
  for (size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_EQ(DecodeShootOptions(bytes.substr(0, size)).status().code(),
              absl::StatusCode::kDataLoss);
  }
  EXPECT_FALSE(DecodeShootOptions(bytes + '\0').ok());
  ShootOptions invalid = UnusualOptions();
  invalid.pyramids.split = 5;
  EXPECT_EQ(GetErrorDetail(DecodeShootOptions(EncodeShootOptions(invalid)).status())->where,
            "phs-split");
}

TEST(ShootOptionsCodec, TakesOnlyValidOptionsFromDamagedBytes) {
  TestRandom random(1);
  const std::string bytes = EncodeShootOptions(UnusualOptions());
  for (int k = 0; k < 10000; ++k) {
    std::string damaged = bytes;
    damaged[random.Below(bytes.size())] ^= static_cast<char>(1 + random.Below(255));
    const absl::StatusOr<ShootOptions> read = DecodeShootOptions(damaged);
    if (read.ok()) {
      EXPECT_TRUE(read->Validate().ok());
    }
  }
}

}  // namespace
}  // namespace lambert
