#include "app/command_line.h"

#include <map>

#include "app/exit.h"
#include "gtest/gtest.h"

namespace lambert::app {
namespace {

using Environment = std::map<std::string, std::string>;

absl::StatusOr<ParsedLine> Parse(const std::vector<std::string>& arguments,
                                 const std::string& toml = "",
                                 const Environment& environment = {}) {
  return ParseCommandLine(arguments, toml, [&](const std::string& name) -> const char* {
    const auto found = environment.find(name);
    return found == environment.end() ? nullptr : found->second.c_str();
  });
}

// The options of a line that has to be good.
Options Good(const std::vector<std::string>& arguments, const std::string& toml = "",
             const Environment& environment = {}) {
  auto parsed = Parse(arguments, toml, environment);
  EXPECT_TRUE(parsed.ok()) << parsed.status();
  return parsed.ok() && parsed->options ? *parsed->options : Options();
}

// The message of a line that has to be a usage error.
std::string Bad(const std::vector<std::string>& arguments, const std::string& toml = "",
                const Environment& environment = {}) {
  auto parsed = Parse(arguments, toml, environment);
  if (parsed.ok()) return "accepted";
  EXPECT_EQ(ExitCodeFor(parsed.status()), ExitCode::kUsage) << parsed.status();
  return std::string(parsed.status().message());
}

TEST(CommandLine, EveryOptionOfTheContractActs) {
  const Options options = Good({"bake",        "room.glb",
                                "-o",          "out",
                                "--method",    "phs",
                                "--max-error", "0.02",
                                "--max-rays",  "1e7",
                                "--max-time",  "60",
                                "--seed",      "18446744073709551615",
                                "--max-edge",  "0.25",
                                "--workers",   "2",
                                "--threads",   "3",
                                "--reference", "r.csv",
                                "--region",    "desk",
                                "--region",    "floor",
                                "--two-sided", "--emission-unit",
                                "W/m2/sr",     "--scene-unit",
                                "cm",          "--blend",
                                "omit",        "--phs-initial",
                                "5",           "--phs-split",
                                "3",           "--phs-depth",
                                "1",           "--phs-alpha1",
                                "0.5",         "--phs-alpha2",
                                "2",           "--phs-sampling",
                                "solid-angle", "--phs-min-rays",
                                "16",          "--with",
                                "black",       "--json",
                                "--progress",  "json"});
  EXPECT_EQ(options.command, Command::kBake);
  EXPECT_EQ(options.scene_path, "room.glb");
  EXPECT_EQ(options.out_folder, "out");
  EXPECT_EQ(options.solve.shoot.method, Method::kPhs);
  EXPECT_EQ(options.solve.max_error, 0.02);
  EXPECT_EQ(options.solve.max_rays, 10'000'000);
  EXPECT_EQ(options.solve.max_time_s, 60);
  EXPECT_EQ(options.solve.seed, 18446744073709551615u);
  EXPECT_EQ(options.patch.max_edge_m, 0.25);
  EXPECT_TRUE(options.patch.two_sided);
  EXPECT_EQ(options.patch.emission_unit, EmissionUnit::kWattPerM2PerSr);
  EXPECT_EQ(options.patch.metres_per_unit, 0.01);
  EXPECT_EQ(options.patch.blend, Blend::kOmit);
  EXPECT_EQ(options.workers, 2);
  EXPECT_EQ(options.threads, 3);
  EXPECT_EQ(options.reference_path, "r.csv");
  EXPECT_EQ(options.regions, (std::vector<std::string>{"desk", "floor"}));
  const PyramidOptions& pyramids = options.solve.shoot.pyramids;
  EXPECT_EQ(pyramids.initial, 5);
  EXPECT_EQ(pyramids.split, 3);
  EXPECT_EQ(pyramids.depth, 1);
  EXPECT_EQ(pyramids.alpha1, 0.5);
  EXPECT_EQ(pyramids.alpha2, 2);
  EXPECT_EQ(pyramids.sampling, PyramidSampling::kSolidAngle);
  EXPECT_EQ(pyramids.min_rays, 16);
  EXPECT_TRUE(options.solve.shoot.parts.with.Has(Part::kBlack));
  EXPECT_TRUE(options.json);
  EXPECT_EQ(options.progress, ProgressMode::kJson);
}

TEST(CommandLine, DefaultsAreThoseOfTheLibrary) {
  const Options options = Good({"bake", "room.glb", "-o", "out"});
  const PyramidOptions pyramids = options.solve.shoot.pyramids;
  EXPECT_EQ(options.solve.shoot.method, Method::kAuto);
  EXPECT_EQ(options.solve.seed, SolveOptions().seed);
  EXPECT_EQ(options.solve.max_error, 0);
  EXPECT_EQ(pyramids.initial, PyramidOptions().initial);
  EXPECT_EQ(pyramids.sampling, PyramidOptions().sampling);
  EXPECT_EQ(options.workers, 1);
  EXPECT_EQ(options.server, "");
}

TEST(CommandLine, AFlagWinsOverTheEnvironmentAndThatOverTheFile) {
  const std::string toml = "seed = 3\n";
  const Environment environment = {{"LAMBERT_SEED", "2"}};
  EXPECT_EQ(Good({"plan", "a.glb"}, toml).solve.seed, 3u);
  EXPECT_EQ(Good({"plan", "a.glb"}, toml, environment).solve.seed, 2u);
  EXPECT_EQ(Good({"plan", "a.glb", "--seed", "1"}, toml, environment).solve.seed, 1u);
}

TEST(CommandLine, EveryOptionHasAVariableAndAKey) {
  const Environment environment = {{"LAMBERT_METHOD", "pmcr"},    {"LAMBERT_MAX_RAYS", "2M"},
                                   {"LAMBERT_TWO_SIDED", "true"}, {"LAMBERT_JSON", "true"},
                                   {"LAMBERT_SERVER", "host:1"},  {"LAMBERT_OUT", "out"}};
  const Options options =
      Good({"bake", "a.glb"}, "region = [\"a\", \"b\"]\nphs-depth = 3\n", environment);
  EXPECT_EQ(options.solve.shoot.method, Method::kPmcr);
  EXPECT_EQ(options.solve.max_rays, 2'000'000);
  EXPECT_TRUE(options.patch.two_sided);
  EXPECT_TRUE(options.json);
  EXPECT_EQ(options.server, "host:1");
  EXPECT_EQ(options.out_folder, "out");
  EXPECT_EQ(options.regions, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(options.solve.shoot.pyramids.depth, 3);
}

TEST(CommandLine, SettingsOfOtherCommandsAreLeftAlone) {
  EXPECT_EQ(Good({"jobs", "--server", "h:1"}, "max-error = 0.01\n").command, Command::kJobs);
}

TEST(CommandLine, PartsComeByCommasAndOneByOneAndFromEverySource) {
  const auto with = [](const Options& options) { return options.solve.shoot.parts.with.Text(); };
  EXPECT_EQ(with(Good({"plan", "a.glb"})), "none");
  EXPECT_EQ(with(Good({"plan", "a.glb", "--with", "black,color", "--with", "ambient"})),
            "color,black,ambient");
  EXPECT_EQ(with(Good({"plan", "a.glb"}, "with = [\"black\", \"color\"]\n")), "color,black");
  EXPECT_EQ(with(Good({"plan", "a.glb"}, "", {{"LAMBERT_WITH", "black,color"}})), "color,black");
  const Options without = Good({"plan", "a.glb", "--without", "std-error"});
  EXPECT_TRUE(without.solve.shoot.parts.without.Has(Part::kStdError));
}

TEST(CommandLine, PartsThatAreNoneOrBothAreRefused) {
  const std::string unknown = Bad({"plan", "a.glb", "--without", "color,colour"});
  EXPECT_EQ(unknown.find("--without: 'colour' is not color|pyramids|"), 0u) << unknown;
  EXPECT_EQ(Bad({"plan", "a.glb", "--with", "color,black", "--without", "black"}),
            "with, without: black stands in both; name it in one of them");
}

TEST(CommandLine, OutputsAreAllOrThoseThatAreNamed) {
  const OutputFiles all = Good({"bake", "a.glb", "-o", "out"}).outputs;
  EXPECT_TRUE(all.csv && all.glb && all.exr && all.png && all.report);
  const OutputFiles some = Good({"bake", "a.glb", "-o", "out", "--outputs", "csv,png"}).outputs;
  EXPECT_TRUE(some.csv && some.png && !some.glb && !some.exr && !some.report);
  EXPECT_EQ(Bad({"bake", "a.glb", "-o", "out", "--outputs", "jpg"}),
            "--outputs: 'jpg' is not one of csv, glb, exr, png, report; see lambert bake --help");
}

TEST(CommandLine, AnExposureIsAutomaticOrAnExposureValue) {
  const PictureOptions plain = Good({"bake", "a.glb", "-o", "out"}).picture;
  EXPECT_EQ(plain.tone_map, ToneMap::kFilmic);
  EXPECT_EQ(plain.exposure_per_lm_per_m2, 0);
  const PictureOptions given = Good({"fetch", "solveJobs/a", "--server", "h:1", "-o", "out",
                                     "--exposure", "-2.5", "--tone-map", "linear"})
                                   .picture;
  EXPECT_EQ(given.tone_map, ToneMap::kLinear);
  EXPECT_DOUBLE_EQ(given.exposure_per_lm_per_m2, ExposureOfEv100(-2.5));
  EXPECT_EQ(
      Good({"bake", "a.glb", "-o", "out", "--exposure", "auto"}).picture.exposure_per_lm_per_m2, 0);
  EXPECT_EQ(Bad({"bake", "a.glb", "-o", "out", "--exposure", "101"}),
            "--exposure: '101' is neither auto nor a number from -100 to 100; see lambert bake "
            "--help");
  EXPECT_EQ(Bad({"bake", "a.glb", "-o", "out", "--tone-map", "aces"}),
            "--tone-map: 'aces' is not one of filmic, linear; see lambert bake --help");
}

TEST(CommandLine, QualityIsAWantedErrorByName) {
  EXPECT_EQ(Good({"plan", "a.glb", "--quality", "preview"}).solve.max_error, 0.1);
  EXPECT_EQ(Good({"bake", "a.glb", "-o", "x"}).final_gather_rays, 0);
  EXPECT_EQ(Good({"bake", "a.glb", "-o", "x", "--quality", "final"}).final_gather_rays, 64);
  EXPECT_EQ(Good({"bake", "a.glb", "-o", "x", "--quality", "final", "--final-gather", "0"})
                .final_gather_rays,
            0);
  EXPECT_EQ(Good({"plan", "a.glb", "--quality", "draft"}).solve.max_error, 0.03);
  EXPECT_EQ(Good({"plan", "a.glb", "--quality", "final"}).solve.max_error, 0.01);
}

TEST(CommandLine, DraftAndFinalQualityAdaptPatchesUnlessTheyAreToStayAsTheyAre) {
  const auto patches = [](std::vector<std::string> more) {
    std::vector<std::string> line = {"plan", "a.glb"};
    line.insert(line.end(), more.begin(), more.end());
    return Good(line).patch.adapt_patches;
  };
  EXPECT_EQ(patches({}), 0);
  EXPECT_EQ(patches({"--quality", "preview"}), 0);
  EXPECT_EQ(patches({"--quality", "draft"}), 50'000);
  EXPECT_EQ(patches({"--quality", "final"}), 200'000);
  EXPECT_EQ(patches({"--adapt", "on"}), 50'000);
  EXPECT_EQ(patches({"--quality", "draft", "--adapt", "off"}), 0);
  EXPECT_EQ(patches({"--quality", "draft", "--adapt-patches", "3k"}), 3000);
  EXPECT_EQ(patches({"--quality", "draft", "--max-edge", "0"}), 0);
  EXPECT_EQ(patches({"--quality", "draft", "--max-edge", "0.5"}), 50'000);
  EXPECT_EQ(patches({"--quality", "draft", "--reference", "a.csv"}), 0);
  EXPECT_EQ(patches({"--quality", "draft", "--reference", "a.csv", "--adapt", "on"}), 50'000);
}

TEST(CommandLine, OfAQualityAndAnErrorTheStrongerSourceWinsAndThenTheNumber) {
  EXPECT_EQ(Good({"plan", "a.glb", "--quality", "final", "--max-error", "0.2"}).solve.max_error,
            0.2);
  EXPECT_EQ(Good({"plan", "a.glb", "--quality", "final"}, "max-error = 0.2\n").solve.max_error,
            0.01);
  EXPECT_EQ(Good({"plan", "a.glb", "--max-error", "0.2"}, "quality = \"final\"\n").solve.max_error,
            0.2);
}

TEST(CommandLine, MistakesNameTheChoices) {
  std::string methods = "auto";
  for (Method method : AllMethods()) methods += std::string(", ") + MethodName(method);
  EXPECT_EQ(Bad({}).find("lambert: no command given (bake, plan, submit"), 0u) << Bad({});
  EXPECT_NE(Bad({"bkae"}).find("did you mean lambert bake"), std::string::npos) << Bad({"bkae"});
  EXPECT_EQ(Bad({"bake", "a.glb", "-o", "out", "--method", "radiance"}),
            "--method: 'radiance' is not one of " + methods + "; see lambert bake --help");
  EXPECT_EQ(Bad({"bake", "a.glb", "-o", "out", "--max-eror", "1"}),
            "lambert bake: '--max-eror' is no option; did you mean --max-error");
  EXPECT_EQ(Bad({"bake", "a.glb", "b.glb", "-o", "out"}),
            "lambert bake: 'b.glb' is one argument too many; see lambert bake --help");
  EXPECT_EQ(Bad({"bake", "-o", "out"}), "lambert bake: SCENE is required; see lambert bake --help");
  EXPECT_EQ(Bad({"bake", "a.glb"}), "lambert bake: no folder for the result; add -o DIR");
  EXPECT_EQ(Bad({"plan", "a.glb"}, "method = \"x\"\n"),
            "lambert.toml, method: 'x' is not one of " + methods + "; see lambert plan --help");
  EXPECT_EQ(Bad({"plan", "a.glb"}, "", {{"LAMBERT_METHOD", "x"}}),
            "LAMBERT_METHOD: 'x' is not one of " + methods + "; see lambert plan --help");
  EXPECT_NE(Bad({"jobs"}).find("no server given"), std::string::npos);
}

TEST(CommandLine, NumbersOutOfRangeAreRefusedByName) {
  for (const auto& [flag, value] : std::vector<std::pair<std::string, std::string>>{
           {"--max-error", "-1"},     {"--max-error", "nan"},   {"--max-error", "inf"},
           {"--max-error", "1%"},     {"--max-rays", "1.5"},    {"--max-rays", "-1"},
           {"--max-rays", "1e30"},    {"--max-rays", ""},       {"--max-time", "soon"},
           {"--seed", "-1"},          {"--seed", "x"},          {"--max-edge", "-0.1"},
           {"--workers", "0"},        {"--threads", "0"},       {"--phs-initial", "2"},
           {"--phs-split", "5"},      {"--phs-depth", "9"},     {"--phs-alpha1", "-1"},
           {"--phs-sampling", "x"},   {"--phs-min-rays", "-1"}, {"--quality", "best"},
           {"--emission-unit", "lm"}, {"--progress", "loud"},   {"--scene-unit", "km"},
           {"--blend", "half"}}) {
    const std::string message = Bad({"bake", "a.glb", "-o", "out", flag + "=" + value});
    EXPECT_EQ(message.find(flag + ": "), 0u) << flag << "=" << value << ": " << message;
  }
}

TEST(CommandLine, CountsMayBeWrittenShort) {
  EXPECT_EQ(Good({"plan", "a.glb", "--max-rays", "10M"}).solve.max_rays, 10'000'000);
  EXPECT_EQ(Good({"plan", "a.glb", "--max-rays", "2.5k"}).solve.max_rays, 2500);
  EXPECT_EQ(Good({"plan", "a.glb", "--max-rays", "1G"}).solve.max_rays, 1'000'000'000);
}

TEST(CommandLine, HelpAndVersionAreResults) {
  const auto help = Parse({"bake", "--help"});
  ASSERT_TRUE(help.ok()) << help.status();
  EXPECT_FALSE(help->options);
  for (const char* option : {"--method", "--max-error", "--phs-alpha2", "--region", "--progress"}) {
    EXPECT_NE(help->text.find(option), std::string::npos) << option;
  }
  const auto version = Parse({"--version"});
  ASSERT_TRUE(version.ok());
  EXPECT_EQ(version->text, std::string("lambert ") + LAMBERT_VERSION + "\n");
}

TEST(CommandLine, AFlagWithoutEffectIsWarnedOf) {
  const auto parsed = Parse({"bake", "a.glb", "-o", "out", "--server", "h:1", "--workers", "2",
                             "--method", "pmcr", "--phs-depth", "1", "--region", "desk"});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  ASSERT_EQ(parsed->warnings.size(), 3u);
  EXPECT_NE(parsed->warnings[0].find("--phs-depth"), std::string::npos);
  EXPECT_NE(parsed->warnings[1].find("--workers"), std::string::npos);
  EXPECT_NE(parsed->warnings[2].find("--region"), std::string::npos);
}

TEST(CommandLine, WhatAMethodDoesNotLookAtIsWarnedOf) {
  const auto warnings = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"bake", "room.glb", "-o", "out", "--region", "0"});
    const auto parsed = Parse(more);
    EXPECT_TRUE(parsed.ok()) << parsed.status();
    std::string all;
    for (const std::string& warning : parsed->warnings) all += warning + "\n";
    return all;
  };
  EXPECT_EQ(warnings({"--method", "importance", "--phs-rule", "variance", "--phs-metric", "1",
                      "--allocation", "variance", "--phs-depth", "1", "--sequence", "sobol"}),
            "warning: --phs-rule has no effect with --method importance\n"
            "warning: --phs-metric has no effect with --method importance\n"
            "warning: --allocation has no effect with --method importance\n");
  const std::string exact = warnings({"--method", "exact", "--reference", "r.csv", "--sequence",
                                      "sobol", "--allocation", "variance", "--phs-rule", "count"});
  EXPECT_EQ(exact,
            "warning: --sequence has no effect with --method exact\n"
            "warning: --allocation has no effect with --method exact\n"
            "warning: --phs-rule has no effect with --method exact\n");
  EXPECT_EQ(warnings({"--method", "pmcr", "--reference", "r.csv", "--sequence", "sobol",
                      "--allocation", "variance"}),
            "");
}

}  // namespace
}  // namespace lambert::app
