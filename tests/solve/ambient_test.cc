#include "radiosity/solve/ambient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Flux of one channel that is unsent or shot, summed over patches.
double Sum(const std::vector<UnsentFlux>& flux) {
  double sum = 0;
  for (const UnsentFlux& unsent : flux) sum += unsent.flux_lm.r;
  return sum;
}

// A step that shoots `rays` rays from the first patch, of 64 quanta of 1/64 lm each, and of which
// all but `lost` rays arrive at patch 1.
struct Shot {
  Shot(uint32_t rays, int64_t lost) {
    const auto quanta = static_cast<int64_t>(64) * rays;
    plan.quantum_lm = {1.0 / 64, 1.0 / 64, 1.0 / 64};
    plan.visits = {{0, rays, 0, rays, {quanta, quanta, quanta}}};
    plan.rays = rays;
    const int64_t arrived = quanta - 64 * lost;
    result.deposits = {{arrived, arrived, arrived, rays - lost, 1}};
    result.escaped = {64 * lost, 64 * lost, 64 * lost};
    result.shot = {quanta, quanta, quanta};
    result.rays = rays;
  }
  StepPlan plan;
  UnitResult result;
};

// Tells of a shot of just that flux in the first group.
void Learn(Ambient& ambient, const Shot& shot) {
  const double lm = shot.plan.visits[0].ray_count;
  ambient.Learn(0, {{0, {lm, lm, lm}}}, shot.plan, shot.result);
}

class AmbientOfAFurnace : public testing::Test {
 protected:
  // Loses a two-hundredth at every bounce.
  const PatchSet patches_ = PatchesOf(MakeFurnace(0.995));
  const std::vector<int32_t> groups_ = std::vector<int32_t>(patches_.size(), 0);
  Ambient ambient_{patches_, groups_, {}, {0.1, 0.2, 0}};
  FluxLedger ledger_{patches_};  // 6 m2 that emit 1 lm/m2
};

TEST_F(AmbientOfAFurnace, ShootsNothingAheadBeforeRaysHaveTold) {
  EXPECT_EQ(Sum(ambient_.Ahead(ledger_)), 0);
  EXPECT_TRUE(ambient_.Helps());
  const Shot shot(99, 0);
  Learn(ambient_, shot);
  EXPECT_EQ(Sum(ambient_.Ahead(ledger_)), 0);
}

TEST_F(AmbientOfAFurnace, ShootsAheadWhatTheUnsentFluxWillBecome) {
  const Shot shot(1000, 0);
  Learn(ambient_, shot);
  const std::vector<UnsentFlux> ahead = ambient_.Ahead(ledger_);
  EXPECT_NEAR(Sum(ahead), 199 * 6, 1e-9)
      << "of two hundred times the emission a two-hundredth is lost";
  ASSERT_EQ(ahead.size(), 12u);
  for (const UnsentFlux& flux : ahead) EXPECT_NEAR(flux.flux_lm.g, 199 * 0.5, 1e-9);
  ledger_.Add({{2, {-24, -24, -24}}});
  EXPECT_NEAR(Sum(ambient_.Ahead(ledger_)), 199 * (6 - 24), 1e-9) << "a debt is a loss to come";
}

TEST_F(AmbientOfAFurnace, GivesUpWhereMuchEscapes) {
  const Shot shot(100000, 20000);
  Learn(ambient_, shot);
  EXPECT_FALSE(ambient_.Helps()) << "it dies out by itself";
  EXPECT_EQ(Sum(ambient_.Ahead(ledger_)), 0);
}

TEST_F(AmbientOfAFurnace, LearnsFromWhatEscapes) {
  // A thousandth escapes, and a two-hundredth of the rest is absorbed; ten rays' worth is guessed.
  const Shot shot(1000000, 1000);
  Learn(ambient_, shot);
  EXPECT_NEAR(Sum(ambient_.Ahead(ledger_)), 6 * (1 / (1 - 0.995 * 0.999) - 1), 0.01);
}

TEST_F(AmbientOfAFurnace, KeepsTheSumOfAGroupWhateverIsRounded) {
  const Shot shot(1000, 0);  // 1000 lm
  const std::vector<UnsentFlux> sent = {{0, {900, 900, 900}}, {3, {102, 102, 102}}};
  const std::vector<UnsentFlux> rest = ambient_.Learn(0, sent, shot.plan, shot.result);
  EXPECT_NEAR(Sum(rest), 2, 1e-11);
  EXPECT_EQ(rest.size(), 12u);
  EXPECT_EQ(Sum(ambient_.Learn(kNoGroup, sent, shot.plan, shot.result)), 0);
}

TEST_F(AmbientOfAFurnace, IsDoneWhenLittleIsLeftForItsRays) {
  EXPECT_EQ(ambient_.Left(ledger_), 1) << "nothing was shot";
  EXPECT_FALSE(ambient_.IsDone(ledger_, 0));
  const Shot shot(36000, 0);
  Learn(ambient_, shot);
  // 6 lm unsent and 1194 to be shot for them, in each of three channels, by 36,000 shot.
  EXPECT_NEAR(ambient_.Left(ledger_), 1200.0 / 36000, 1e-9);
  EXPECT_FALSE(ambient_.IsDone(ledger_, 0));
  // 36,000 rays know a mean to a 190th: a tenth of that.
  ledger_.Add(Scaled(ledger_.unsent(), -0.99));
  EXPECT_NEAR(ambient_.Left(ledger_), 12.0 / 36000, 1e-9);
  EXPECT_TRUE(ambient_.IsDone(ledger_, 0));
}

TEST(Ambient, KnowsARoomThatLosesNothing) {
  const PatchSet patches = PatchesOf(MakeFurnace(1));
  const std::vector<int32_t> groups(patches.size(), 0);
  Ambient ambient(patches, groups, {}, {1, 1, 0}), leaking(patches, groups, {}, {1, 1, 0});
  const Shot closed(600000, 0), open(600000, 1);
  for (int k = 0; k < 2; ++k) {
    EXPECT_FALSE(ambient.LosesNothing());
    Learn(ambient, closed);
    Learn(leaking, open);
  }
  EXPECT_TRUE(ambient.LosesNothing());
  EXPECT_FALSE(leaking.LosesNothing());
  EXPECT_TRUE(leaking.Helps());
}

// Each stiff group is shot for itself, with rays enough to be known; all else together.
TEST(Ambient, KeepsGroupsApart) {
  const Paint bright{{0.999, 0.999, 0.999}, {1, 1, 1}},
      dim{{0.999, 0.999, 0.999}, {1e-9, 1e-9, 1e-9}}, gray{{0.5, 0.5, 0.5}, {1, 1, 1}};
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({0, 0, 0}, {1, 1, 1}, true, {bright})
                                         .Box({3, 0, 0}, {4, 1, 1}, true, {dim})
                                         .Box({6, 0, 0}, {7, 1, 1}, true, {gray})
                                         .Light({6.5, 0.5, 0.5}, {1, 1, 1})
                                         .Make());
  std::vector<int32_t> groups;
  for (const PatchSource& source : patches.source) groups.push_back(source.node);
  Ambient ambient(patches, groups, {}, {0.01, 0.02, 0});
  const FluxLedger ledger(patches);
  const std::vector<Ambient::Part> parts = ambient.Divide(ledger.unsent());
  ASSERT_EQ(parts.size(), 3u);
  size_t emitters = 0;
  for (const Ambient::Part& part : parts) {
    emitters += part.unsent.size();
    for (const UnsentFlux& flux : part.unsent) {
      const int32_t group = flux.emitter < patches.size() ? groups[flux.emitter] : 2;
      EXPECT_EQ(part.group, group < 2 ? group : kNoGroup);
    }
  }
  EXPECT_EQ(emitters, ledger.unsent().size());
  EXPECT_EQ(parts[0].flux_per_ray_lm, 0.01) << "18 lm make 1800 rays";
  EXPECT_LT(parts[1].flux_per_ray_lm, 18e-9 / 400);
  EXPECT_EQ(parts[2].flux_per_ray_lm, 0.02);

  Shot shot(1000, 0);
  ambient.Learn(parts[0].group, parts[0].unsent, shot.plan, shot.result);
  for (const UnsentFlux& flux : ambient.Ahead(ledger)) EXPECT_EQ(groups[flux.emitter], 0);
  EXPECT_FALSE(ambient.IsDone(ledger, 1e9)) << "one group has yet to be shot";

  shot.plan.visits[0].emitter = parts[1].unsent[0].emitter;
  ambient.Learn(parts[1].group, parts[1].unsent, shot.plan, shot.result);
  const std::vector<UnsentFlux> ahead = ambient.Ahead(ledger);
  EXPECT_TRUE(std::ranges::is_sorted(ahead, {}, &UnsentFlux::emitter));
  std::set<int32_t> shot_ahead;
  for (const UnsentFlux& flux : ahead) shot_ahead.insert(groups[flux.emitter]);
  EXPECT_EQ(shot_ahead, (std::set<int32_t>{0, 1}));
}

}  // namespace
}  // namespace lambert
