#include "radiosity/output/run_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

RunRecord SomeRecord() {
  return RecordOf(PatchesOf(MakeCornell()), [](Vec3) { return Rgb{1, 1, 1}; });
}

TEST(EncodeRunJson, HoldsOptionsPlanLedgerTotalsAndTimings) {
  const RunRecord record = SomeRecord();
  const Json json = Json::parse(EncodeRunJson(record, PictureFacts{{}, {0.25}}));
  EXPECT_EQ(json["name"], "room");
  EXPECT_EQ(json["scene_digest"], std::string(64, 'a'));
  EXPECT_EQ(json["seed"], 1);
  EXPECT_EQ(json["options"]["method"], json["method"]);
  EXPECT_EQ(json["options"]["max_error"], kDefaultMaxError);
  EXPECT_EQ(json["stop_reason"], "error_reached");
  EXPECT_EQ(json["versions"]["lambert"], "0.1.0");
  EXPECT_EQ(json["pins"], "pins-1");
  EXPECT_EQ(json["plan"]["items"].size(), record.plan.items.size());
  EXPECT_EQ(json["plan"]["items"][0]["reason"], record.plan.items[0].reason);
  EXPECT_EQ(json["ledger"]["unit"], "lm");
  EXPECT_EQ(json["ledger"]["emitted"][1], record.snapshot.solution->ledger.emitted.g);
  EXPECT_EQ(json["totals"]["rays"], 123456);
  EXPECT_EQ(json["totals"]["patches"], record.patches->size());
  EXPECT_EQ(json["timings_s"]["solve"], 1.5);
  EXPECT_EQ(json["picture"]["exposure_per_lm_per_m2"], 0.25);
  EXPECT_FALSE(json.contains("measures"));
}

TEST(NeverHit, AreThePatchesWithoutHitsWhereThatLeavesTheirLightOpen) {
  RunRecord record = SomeRecord();
  Solution solution = *record.snapshot.solution;
  solution.hits.assign(record.patches->size(), 5);
  solution.hits[3] = solution.hits[7] = 0;
  record.snapshot.solution = std::make_shared<const Solution>(solution);
  EXPECT_EQ(NeverHit(record), (std::vector<PatchIndex>{3, 7}));
  EXPECT_EQ(Json::parse(EncodeRunJson(record, PictureFacts{}))["totals"]["patches_never_hit"], 2);
  record.stop_reason = StopReason::kNothingToShoot;
  EXPECT_TRUE(NeverHit(record).empty());
  record.stop_reason = StopReason::kErrorReached;
  record.plan.options.shoot.method = Method::kExact;
  EXPECT_TRUE(NeverHit(record).empty());
}

TEST(EncodeRunJson, TellsWhatAdaptiveMeshingDidWhereItWasOn) {
  RunRecord record = SomeRecord();
  EXPECT_FALSE(Json::parse(EncodeRunJson(record, PictureFacts{})).contains("meshing"));
  record.meshing = Meshing{.coarse_patches = 12, .pilots = 2, .reason = "enough"};
  const Json meshing = Json::parse(EncodeRunJson(record, PictureFacts{}))["meshing"];
  EXPECT_EQ(meshing["coarse_patches"], 12);
  EXPECT_EQ(meshing["pilots"], 2);
  EXPECT_EQ(meshing["reason"], "enough");
  EXPECT_TRUE(meshing["predicted_rms_area"].is_null()) << "no pilot told any";
}

TEST(EncodeRunJson, WhatIsNotKnownIsNull) {
  RunRecord record = SomeRecord();
  record.snapshot.progress.estimated_rms_area = -1;
  record.measures = ErrorMeasures{0.1, 0.2, std::nullopt, 0.3, 0.4};
  const Json json = Json::parse(EncodeRunJson(record, PictureFacts{}));
  EXPECT_TRUE(json["totals"]["estimated_rms_area"].is_null());
  EXPECT_TRUE(json["measures"]["rms_local"].is_null());
  EXPECT_EQ(json["measures"]["p95"], 0.3);
}

TEST(EncodeRunJson, WithoutAPictureThereAreNoFactsOfIt) {
  const RunRecord record = RecordOf(PatchesOf(MakeCornell()), [](Vec3) { return Rgb{}; });
  EXPECT_TRUE(Json::parse(EncodeRunJson(record, std::nullopt))["picture"].is_null());
  EXPECT_FALSE(Json::parse(EncodeRunJson(record, PictureFacts{}))["picture"].is_null());
}

TEST(EncodeRunJson, TellsHowThePictureWasDeveloped) {
  RunRecord record = SomeRecord();
  const PictureFacts facts{{}, {ExposureOfEv100(3), ToneMap::kLinear}};
  Json picture = Json::parse(EncodeRunJson(record, facts))["picture"];
  EXPECT_EQ(picture["tone_map"], "linear");
  EXPECT_NEAR(picture["exposure_ev100"].get<double>(), 3, 1e-12);
  EXPECT_EQ(picture["exposure_by"], "auto");
  record.picture_options.exposure_per_lm_per_m2 = facts.exposure.per_lm_per_m2;
  picture = Json::parse(EncodeRunJson(record, facts))["picture"];
  EXPECT_EQ(picture["exposure_by"], "option");
}

TEST(EncodeRunJson, AnInterruptedRunSaysSo) {
  RunRecord record = SomeRecord();
  record.interrupted = true;
  EXPECT_EQ(Json::parse(EncodeRunJson(record, PictureFacts{}))["stop_reason"], "interrupted");
}

TEST(EncodeRunJson, RadiometricRunsCountWatts) {
  RunRecord record = SomeRecord();
  record.patch_options.emission_unit = EmissionUnit::kWattPerM2PerSr;
  record.patch_options.metres_per_unit = 0.01;
  record.patch_options.blend = Blend::kOmit;
  const Json json = Json::parse(EncodeRunJson(record, PictureFacts{}));
  EXPECT_EQ(json["ledger"]["unit"], "W");
  EXPECT_EQ(json["options"]["metres_per_unit"], 0.01);
  EXPECT_EQ(json["options"]["blend"], "omit");
}

TEST(EncodeRunJson, BytesThatAreNotUtf8AreReplaced) {
  RunRecord record = SomeRecord();
  record.name = "room \xff";
  EXPECT_TRUE(Json::accept(EncodeRunJson(record, PictureFacts{})));
}

}  // namespace
}  // namespace lambert
