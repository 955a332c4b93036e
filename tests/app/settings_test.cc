#include "app/settings.h"

#include "app/exit.h"
#include "gtest/gtest.h"

namespace lambert::app {
namespace {

const std::vector<std::string> kOptions = {"max-error", "method", "region", "two-sided"};

const char* NoEnvironment(const std::string&) { return nullptr; }

TEST(Settings, AFlatFileGivesValuesOfEveryKindAsText) {
  const auto settings = ReadSettings(kOptions,
                                     "max-error = 0.01\nmethod = \"phs\"\ntwo_sided = true\n"
                                     "region = [\"desk\", \"floor\"]\n",
                                     NoEnvironment);
  ASSERT_TRUE(settings.ok()) << settings.status();
  EXPECT_EQ(settings->at("max-error").values, std::vector<std::string>{"0.01"});
  EXPECT_EQ(settings->at("method").values, std::vector<std::string>{"phs"});
  EXPECT_EQ(settings->at("two-sided").values, std::vector<std::string>{"true"});
  EXPECT_EQ(settings->at("region").values, (std::vector<std::string>{"desk", "floor"}));
}

TEST(Settings, TheEnvironmentWinsOverTheFile) {
  const auto settings =
      ReadSettings(kOptions, "method = \"phs\"\n", [](const std::string& name) -> const char* {
        return name == "LAMBERT_METHOD" ? "pmcr" : nullptr;
      });
  ASSERT_TRUE(settings.ok()) << settings.status();
  EXPECT_EQ(settings->at("method").values, std::vector<std::string>{"pmcr"});
  EXPECT_EQ(settings->at("method").layer, Layer::kEnvironment);
}

TEST(Settings, AnEmptyVariableIsAsGoodAsNone) {
  const auto settings =
      ReadSettings(kOptions, "", [](const std::string& name) -> const char* { return ""; });
  ASSERT_TRUE(settings.ok()) << settings.status();
  EXPECT_TRUE(settings->empty());
}

TEST(Settings, AnUnknownKeyIsRefusedWithTheNearestOne) {
  const auto settings = ReadSettings(kOptions, "max-eror = 0.01\n", NoEnvironment);
  ASSERT_FALSE(settings.ok());
  EXPECT_EQ(ExitCodeFor(settings.status()), ExitCode::kUsage);
  EXPECT_EQ(settings.status().message(),
            "lambert.toml, max-eror: this is no option; did you mean max-error");
}

TEST(Settings, AFileThatIsNotTomlIsRefusedByLine) {
  const auto settings = ReadSettings(kOptions, "method = \"phs\"\nseed == 3\n", NoEnvironment);
  ASSERT_FALSE(settings.ok());
  EXPECT_EQ(ExitCodeFor(settings.status()), ExitCode::kUsage);
  EXPECT_EQ(settings.status().message().find("lambert.toml, line 2: "), 0u) << settings.status();
}

TEST(Settings, ATableIsNoValue) {
  EXPECT_FALSE(ReadSettings(kOptions, "[method]\nid = \"phs\"\n", NoEnvironment).ok());
}

TEST(EnvironmentName, IsUpperCaseWithUnderscores) {
  EXPECT_EQ(EnvironmentName("phs-alpha1"), "LAMBERT_PHS_ALPHA1");
}

TEST(NearestWord, ForgivesSlipsAndNothingMore) {
  EXPECT_EQ(NearestWord("wathc", {"watch", "fetch"}), "watch");
  EXPECT_EQ(NearestWord("render", {"watch", "fetch"}), "");
}

}  // namespace
}  // namespace lambert::app
