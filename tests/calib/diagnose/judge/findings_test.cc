#include "calib/diagnose/judge/findings.h"

#include <gmock/gmock.h>

#include "model/effects/effects.h"

namespace armcal::findings_test {

using testing::ElementsAre;

FoundEffect Found(const std::string& name, int joint, double drop) {
  FoundEffect found;
  found.effect = FindEffect(name);
  found.joint = joint;
  found.drop = drop;
  return found;
}

std::vector<std::string> Names(const std::vector<FoundEffect>& effects) {
  std::vector<std::string> names;
  for (const FoundEffect& found : effects) {
    names.push_back(found.effect->name + "@" + std::to_string(found.joint + 1));
  }
  return names;
}

std::vector<std::string> Sorted(std::vector<FoundEffect> effects) {
  SortFindings(&effects);
  return Names(effects);
}

TEST(IsThereWithoutName, WhereHeldOutDataHaveItAndGainByIt) {
  FoundEffect seen = Found("delay", -1, 112), spoils = Found("spring", 1, 200);
  seen.evidence.confirmation = {1300, 3800};
  spoils.evidence.confirmation = {2500, -5000};
  GapFigures held_out;
  held_out.refit = 2;
  held_out.after = 1.5;
  EXPECT_TRUE(IsThereWithoutName({seen, spoils}, held_out));
  EXPECT_FALSE(IsThereWithoutName({spoils}, held_out));
  EXPECT_FALSE(IsThereWithoutName({}, held_out));
  held_out.after = 4;
  EXPECT_FALSE(IsThereWithoutName({seen, spoils}, held_out));
}

// A log that the model explains better than its noise lacks nothing there, and
// what is smaller than what the best of models lack is none.
TEST(IsNeeded, WhereThereIsMoreThanNoiseAndModelsLack) {
  FoundEffect found = Found("vibration", 0, 10000);
  EXPECT_TRUE(IsNeeded(found, .25));
  found.gap = .8;
  EXPECT_TRUE(IsNeeded(found, .25));
  found.gap = .7;
  EXPECT_FALSE(IsNeeded(found, .25));
  EXPECT_TRUE(IsNeeded(found, 1)) << "noise that is hardly known";
  found.gap = 2;
  found.size = .0011;
  EXPECT_TRUE(IsNeeded(found, .25));
  found.size = .0009;
  EXPECT_FALSE(IsNeeded(found, .25));
}

TEST(GiveUpWorst, TakesWhatRemovesLeastOfWhatIsFitted) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9), Found("stribeck", 1, 8),
                      Found("viscous_friction", -1, 7)};
  findings.effects[0].fitted = {0};
  findings.effects[0].removed_percent = 5;
  findings.effects[1].fitted = {1};
  findings.effects[1].removed_percent = -70;
  findings.effects[2].removed_percent = -90;  // a change since the reference
  EXPECT_TRUE(GiveUpWorst(&findings));
  EXPECT_THAT(Names(findings.unnamed), ElementsAre("stribeck@2"));
  EXPECT_TRUE(GiveUpWorst(&findings));
  EXPECT_FALSE(GiveUpWorst(&findings));
  EXPECT_THAT(Names(findings.effects), ElementsAre("viscous_friction@0"));
}

class IsClaimedTest : public testing::Test {
 protected:
  // chi^2 that held-out data should have of it, and have.
  bool Claimed(double probability, double gain, double expected = 500,
               double explained = 500) {
    found_.probability = probability;
    found_.evidence.gain = gain;
    found_.evidence.confirmation = {expected, explained};
    return IsClaimed(found_);
  }

  FoundEffect found_ = Found("spring", 1, 50);
};

TEST_F(IsClaimedTest, WhatIsLikelyOrHelps) {
  EXPECT_TRUE(Claimed(.5, -.1));
  EXPECT_TRUE(Claimed(.3, .01));
  EXPECT_FALSE(Claimed(.49, 0));
  EXPECT_FALSE(Claimed(.29, 1));
}

TEST_F(IsClaimedTest, WhatHeldOutDataDoNotShowIsLikelier) {
  EXPECT_FALSE(Claimed(.6, .01, 10, 2));
  EXPECT_TRUE(Claimed(.8, .01, 10, 2));
  EXPECT_FALSE(Claimed(.6, .01, 500, 50));
}

TEST_F(IsClaimedTest, WhatHeldOutDataContradictIsNot) {
  EXPECT_FALSE(Claimed(.99, .01, 500, -20));
  // Its form is a little too large, and it helps.
  EXPECT_TRUE(Claimed(.99, .1, 500, -20));
  // Too little to tell.
  EXPECT_TRUE(Claimed(.99, -.01, 20, -10));
  // Less than a law's form is wrong by, of what was fitted.
  found_.drop = 5000;
  EXPECT_TRUE(Claimed(.99, -.01, 500, -20));
  EXPECT_FALSE(Claimed(.99, -.01, 1500, -20));
}

TEST_F(IsClaimedTest, TouchesAreJudgedWhereTheyWere) {
  found_.contacts.resize(1);
  EXPECT_FALSE(Claimed(.49, 1, 0, 0));
  EXPECT_TRUE(Claimed(.5, 0, 0, 0));
}

TEST_F(IsClaimedTest, WhatSwingsInTimeHelps) {
  found_ = Found("vibration", 1, 50);
  EXPECT_TRUE(Claimed(.9, .01));
  EXPECT_FALSE(Claimed(.9, -.01));
}

TEST_F(IsClaimedTest, ALoadIsWithinReachOfTheTool) {
  found_ = Found("payload", -1, 50);
  found_.estimates = {{"mass", "kg", .1}, {"com_x", "m", .3}};
  EXPECT_TRUE(Claimed(.9, .1));
  found_.estimates[1].value = 1.8;
  EXPECT_FALSE(Claimed(.9, .1));
  found_.estimates[1].value = std::nan("");  // not seen
  EXPECT_TRUE(Claimed(.9, .1));
}

TEST(SortFindings, ByDrop) {
  EXPECT_THAT(Sorted({Found("stribeck", 1, 50), Found("spring", 1, 80),
                      Found("payload", -1, 60)}),
              ElementsAre("spring@2", "payload@0", "stribeck@2"));
}

TEST(SortFindings, ALawComesBeforeItsMean) {
  EXPECT_THAT(Sorted({Found("coulomb_friction", 1, 100),
                      Found("position_friction", 1, 60)}),
              ElementsAre("position_friction@2", "coulomb_friction@2"));
}

// A friction that is wrong by much leaves errors of form, which look like laws.
TEST(SortFindings, ALawOfLittleIsNoLaw) {
  EXPECT_THAT(Sorted({Found("coulomb_friction", 1, 100),
                      Found("position_friction", 1, 10)}),
              ElementsAre("coulomb_friction@2", "position_friction@2"));
}

TEST(SortFindings, OtherJointsAreNotItsCompany) {
  EXPECT_THAT(Sorted({Found("viscous_friction", 0, 100),
                      Found("quadratic_friction", 1, 60)}),
              ElementsAre("viscous_friction@1", "quadratic_friction@2"));
}

// Tight spots are more friction on the whole.
TEST(JoinMeans, AMeanIsPartOfItsLaw) {
  std::vector<FoundEffect> effects = {Found("position_friction", 1, 100),
                                      Found("stribeck", 0, 80),
                                      Found("coulomb_friction", 1, 60)};
  effects[0].estimates = {{"friction", "N m", 2}};
  effects[2].estimates = {{"coulomb", "N m", .7}};
  effects[0].stddev = {.1};
  effects[2].stddev = {.2};
  JoinMeans(&effects);
  EXPECT_THAT(Names(effects), ElementsAre("position_friction@2", "stribeck@1"));
  ASSERT_EQ(effects[0].estimates.size(), 2u);
  EXPECT_EQ(effects[0].estimates[1].name, "coulomb");
  EXPECT_EQ(effects[0].estimates[1].value, .7);
  EXPECT_THAT(effects[0].stddev, ElementsAre(.1, .2));
}

TEST(JoinMeans, WhatComesBeforeOrIsElsewhereIsItsOwnEffect) {
  for (const FoundEffect& other :
       {Found("coulomb_friction", 1, 1000), Found("coulomb_friction", 0, 60),
        Found("torque_offset", 1, 60)}) {
    std::vector<FoundEffect> effects = {Found("position_friction", 1, 100),
                                        other};
    SortFindings(&effects);
    JoinMeans(&effects);
    EXPECT_EQ(effects.size(), 2u) << other.effect->name << other.joint;
  }
}

}  // namespace armcal::findings_test
