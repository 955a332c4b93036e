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
  EXPECT_EQ(ReasonOf(status), "FIELD_INVALID");
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
  for (int grid : {0, 65}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.grid = grid; }), "phs-grid");
  }
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.leaves = 3; }), "phs-leaves");
  for (double negative : {-0.1, kNan}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.hier_flux = negative; }), "phs-hier-flux");
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.hier_size = negative; }), "phs-hier-size");
  }
  for (double metric : {-0.1, 1.1, kNan}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.metric = metric; }), "phs-metric");
  }
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.probes = 0; }), "phs-probes");
}

TEST(ShootOptions, ValidationNamesWhatDoesNotGoTogether) {
  ShootOptions adaptive;
  adaptive.method = Method::kPhsAdaptive;
  EXPECT_EQ(Refused(adaptive), "");
  adaptive.pyramids.cells = CellShape::kSquare;
  EXPECT_EQ(Refused(adaptive), "phs-cells");
  ShootOptions squares;
  squares.pyramids.cells = CellShape::kSquare;
  EXPECT_EQ(Refused(squares), "");
  squares.pyramids.sampling = PyramidSampling::kSolidAngle;
  EXPECT_EQ(Refused(squares), "phs-sampling");
  ShootOptions importance;
  importance.method = Method::kImportance;
  EXPECT_EQ(Refused(importance), "region");
  importance.region = {"table"};
  EXPECT_EQ(Refused(importance), "");
}

TEST(ShootOptions, ValidationTakesTheEndsOfEveryRange) {
  for (int initial : {3, 64}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.initial = initial; }), "");
  }
  for (int depth : {0, 4}) {
    EXPECT_EQ(RefusedAfter([&](PyramidOptions& p) { p.depth = depth; }), "");
  }
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.split = 3; }), "");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.hier_flux = p.hier_size = 0; }), "");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.alpha1 = 0; }), "");
  EXPECT_EQ(RefusedAfter([](PyramidOptions& p) { p.alpha2 = 0; }), "");
}

TEST(ParseMethod, TurnsEveryNameBackIntoItsMethod) {
  EXPECT_EQ(*ParseMethod(MethodName(Method::kAuto)), Method::kAuto);
  for (Method method : AllMethods()) {
    EXPECT_EQ(*ParseMethod(MethodName(method)), method);
    EXPECT_NE(method, Method::kAuto);
  }
}

TEST(UsesPyramids, IsTrueWhereRaysAreDivided) {
  EXPECT_FALSE(UsesPyramids(Method::kMcr));
  EXPECT_FALSE(UsesPyramids(Method::kPmcr));
  EXPECT_FALSE(UsesPyramids(Method::kExact));
  EXPECT_FALSE(UsesPyramids(Method::kWalk));
  EXPECT_TRUE(UsesPyramids(Method::kHs97));
  EXPECT_TRUE(UsesPyramids(Method::kPhsAdaptive));
}

TEST(CellCount, IsTheProductOfTheSplitsOrTheSquareOfTheGrid) {
  PyramidOptions options;
  EXPECT_EQ(options.CellCount(), 64);
  options.split = 3;
  options.depth = 3;
  EXPECT_EQ(options.CellCount(), 108);
  options.cells = CellShape::kSquare;
  options.grid = 16;
  EXPECT_EQ(options.CellCount(), 256);
}

TEST(ParseMethod, OfAnUnknownNameNamesTheChoices) {
  for (const char* name : {"", "PHS", "hs99"}) {
    const absl::StatusOr<Method> method = ParseMethod(name);
    ASSERT_FALSE(method.ok());
    const ErrorDetail detail = *GetErrorDetail(method.status());
    EXPECT_EQ(detail.reason, "FIELD_INVALID");
    EXPECT_EQ(detail.where, "method");
    EXPECT_NE(detail.message.find(name), std::string::npos);
    EXPECT_NE(detail.hint.find("auto, mcr, pmcr"), std::string::npos) << detail.hint;
  }
}

ShootOptions UnusualOptions() {
  ShootOptions options;
  options.method = Method::kImportance;
  options.region = {"table", "7"};
  options.sequence = Sequence::kSobol;
  options.allocation = Allocation::kVariance;
  PyramidOptions& p = options.pyramids;
  p.initial = 7;
  p.split = 3;
  p.depth = 1;
  p.grid = 5;
  p.leaves = 17;
  p.rule = DensityRule::kVariance;
  p.metric = 0.3;
  p.alpha1 = 0.25;
  p.alpha2 = 0.1;  // not a sum of powers of two
  p.sampling = PyramidSampling::kSolidAngle;
  options.parts.with.Add(Part::kBlack);
  options.parts.without.Add(Part::kClusters);
  p.count_unseen = true;
  p.probes = 9;
  p.min_rays = 12345;
  return options;
}

TEST(ShootOptionsCodec, GivesEveryFieldBack) {
  ShootOptions squares;
  squares.pyramids.cells = CellShape::kSquare;
  for (const ShootOptions& options : {ShootOptions{}, UnusualOptions(), squares}) {
    const std::string bytes = EncodeShootOptions(options);
    const absl::StatusOr<ShootOptions> read = DecodeShootOptions(bytes);
    ASSERT_TRUE(read.ok()) << read.status();
    EXPECT_EQ(*read, options);
    EXPECT_TRUE(EncodeShootOptions(*read) == bytes);
  }
  EXPECT_FALSE(EncodeShootOptions({}) == EncodeShootOptions(squares));
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
      EXPECT_EQ(EncodeShootOptions(*read), damaged);
    }
  }
}

}  // namespace
}  // namespace lambert
