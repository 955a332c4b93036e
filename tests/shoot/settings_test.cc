#include "radiosity/shoot/settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

TEST(ShootSettings, HaveNamesOfTheirOwnAndGiveBackWhatTheyTake) {
  std::set<std::string> names;
  const ShootOptions defaults;
  for (const ShootSetting& setting : ShootSettings()) {
    EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
    ShootOptions options;
    EXPECT_TRUE(setting.set(setting.get(defaults), options)) << setting.name;
    EXPECT_EQ(options, defaults) << setting.name;
    // What --help says of the default is the default.
    EXPECT_NE(std::string(setting.help).find("(" + setting.get(defaults) + ")"), std::string::npos)
        << setting.help << " " << setting.get(defaults);
  }
}

TEST(ShootSettings, EveryChoiceIsTakenAndChangesTheOptions) {
  for (const ShootSetting& setting : ShootSettings()) {
    std::string choices = setting.value_name;
    if (choices.find('|') == std::string::npos) continue;
    choices = choices.substr(0, choices.find(",..."));  // any number of them
    std::set<std::string> seen;
    for (size_t begin = 0; begin <= choices.size();) {
      const size_t end = std::min(choices.find('|', begin), choices.size());
      ShootOptions options;
      EXPECT_TRUE(setting.set(choices.substr(begin, end - begin), options)) << choices;
      seen.insert(setting.get(options));
      begin = end + 1;
    }
    const auto count = std::count(choices.begin(), choices.end(), '|') + 1;
    EXPECT_EQ(static_cast<long>(seen.size()), count) << setting.name;
  }
}

TEST(ApplySetting, RefusesWhatItDoesNotKnowAndNamesTheChoices) {
  ShootOptions options;
  const absl::Status unknown = ApplySetting("phs-dept", "3", options);
  EXPECT_EQ(unknown.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_NE(GetErrorDetail(unknown)->hint.find("phs-depth"), std::string::npos);
  for (const char* text : {"", "x", "2x", " 2", "nan", "1e99"}) {
    const absl::Status status = ApplySetting("phs-depth", text, options);
    EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument) << text;
    EXPECT_EQ(GetErrorDetail(status)->where, "phs-depth");
  }
  EXPECT_FALSE(ApplySetting("phs-alpha1", "inf", options).ok());
  EXPECT_FALSE(ApplySetting("phs-cells", "circles", options).ok());
  EXPECT_EQ(options, ShootOptions());
}

TEST(ChangedSettings, AreThoseThatDifferAndRestoreThem) {
  EXPECT_TRUE(ChangedSettings({}).empty());
  ShootOptions options;
  options.pyramids.depth = 3;
  options.pyramids.alpha1 = 0.1;
  options.sequence = Sequence::kSobol;
  const auto changed = ChangedSettings(options);
  EXPECT_EQ(changed, (std::map<std::string, std::string>{
                         {"phs-alpha1", "0.1"}, {"phs-depth", "3"}, {"sequence", "sobol"}}));
  ShootOptions restored;
  for (const auto& [name, text] : changed) ASSERT_TRUE(ApplySetting(name, text, restored).ok());
  EXPECT_EQ(restored, options);
}

}  // namespace
}  // namespace lambert
