#include "app/light_options.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/light_files.h"
#include "radiosity/core/error.h"
#include "radiosity/output/exr.h"
#include "radiosity/scene/sky_map.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace lambert::app {
namespace {

// What the options say, or what is wrong with them.
Options Parse(std::vector<std::string> words) {
  CLI::App command;
  Draft draft;
  AddLightOptions(command, draft);
  std::reverse(words.begin(), words.end());
  command.parse(words);
  return draft.options;
}

TEST(LightOptions, SayWhatLightsTheScene) {
  const Options options =
      Parse({"--sky", "overcast", "--sky-illuminance", "5000", "--sun", "180,45.5,90000", "--ies",
             "lamps/a.ies=lamp", "--ies", "b.IES=node=7", "--ies", "lamps/a.ies=3"});
  const LightOptions& lights = options.patch.lights;
  EXPECT_EQ(lights.sky, "overcast");
  EXPECT_EQ(options.sky_path, "");
  EXPECT_EQ(lights.sky_illuminance_lx, 5000);
  EXPECT_EQ(lights.sun_azimuth_deg, 180);
  EXPECT_EQ(lights.sun_elevation_deg, 45.5);
  EXPECT_EQ(lights.sun_illuminance_lx, 90000);
  EXPECT_EQ(lights.lamps, (std::vector<LightOptions::Lamp>{
                              {"a.ies", "lamp"}, {"b.IES", "node=7"}, {"a.ies", "3"}}));
  EXPECT_EQ(options.ies_paths, (std::vector<std::string>{"lamps/a.ies", "b.IES"}));
}

TEST(LightOptions, HaveDefaults) {
  EXPECT_EQ(Parse({"--sun", "90,10"}).patch.lights.sun_illuminance_lx, 100000);
  const Options options = Parse({"--sky", "skies/dusk.exr"});
  EXPECT_EQ(options.sky_path, "skies/dusk.exr");
  EXPECT_EQ(options.patch.lights.sky, "dusk.exr");
}

TEST(LightOptions, WhatTheyCannotBeIsRefused) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--sky", "blue"},
                                             {"--sun", "90"},
                                             {"--sun", "90,91"},
                                             {"--sun", "a,b"},
                                             {"--sun", "1,2,3,4"},
                                             {"--sun", "90,45,-1"},
                                             {"--sky-illuminance", "-1"},
                                             {"--ies", "a.ies"},
                                             {"--ies", "a.ies="},
                                             {"--ies", "lamp=node"}}) {
    EXPECT_THROW(Parse(words), CLI::ParseError) << words[0] << " " << words[1];
  }
}

class LightFiles : public testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& bytes) {
    const std::string path = (std::filesystem::path(folder_.path()) / name).string();
    std::filesystem::create_directories(std::filesystem::path(path).parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  absl::StatusOr<SceneBundle> Read(const Options& options) {
    return ReadLitBundle(Write("room.glb", ToGlb(MakeFurnace(0.5))), options);
  }
  TemporaryFolder folder_;
};

TEST_F(LightFiles, TravelWithTheScene) {
  Picture picture;
  picture.width = 2;
  picture.height = 1;
  picture.radiosity_lm_per_m2 = {{3.14159265, 0, 0}, {0, 6.2831853, 0}};
  picture.irradiance_lx = picture.std_error_lm_per_m2 = {{}, {}};
  picture.patch = {0, 0};
  Options options;
  options.sky_path = Write("dusk.exr", *EncodeExr(picture));
  options.ies_paths = {Write("lamps/a.ies", "a lamp")};
  const auto bundle = Read(options);
  ASSERT_TRUE(bundle.ok()) << bundle.status();
  EXPECT_EQ(bundle->files.at("a.ies"), "a lamp");
  const auto sky = DecodeSkyMap("dusk.exr", bundle->files.at("dusk.exr"));
  ASSERT_TRUE(sky.ok()) << sky.status();
  ASSERT_EQ((*sky)->grid().values.size(), 6u);
  EXPECT_NEAR((*sky)->grid().values[0], 1, 1e-6);
  EXPECT_NEAR((*sky)->grid().values[4], 2, 1e-6);
}

TEST_F(LightFiles, ThatCannotBeReadAreNamed) {
  Options options;
  options.sky_path = Write("text.exr", "this is no picture");
  EXPECT_EQ(ReasonOf(Read(options).status()), "SCENE_INVALID");
  options.sky_path = folder_.path() + "/gone.exr";
  EXPECT_EQ(ReasonOf(Read(options).status()), "SCENE_FILE_MISSING");
  options.sky_path = "";
  options.ies_paths = {Write("a.ies", "1"), Write("other/a.ies", "2")};
  EXPECT_EQ(ReasonOf(Read(options).status()), "FIELD_INVALID");
}

}  // namespace
}  // namespace lambert::app
