#include "calib/diagnose/judge/given_up.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/fixtures/found_effect.h"

namespace armcal::given_up_test {

using testing::ElementsAre;
using testing::SizeIs;

GapFigures Shrinking(double low, double high) {
  GapFigures torque;
  torque.ci95[0] = low;
  torque.ci95[1] = high;
  return torque;
}

// Known exactly, of what says that it would remove 1.
EffectGain Gain(double value) { return {value, 1, {value, value}}; }

TEST(GiveUpWorst, TakesWhatRemovesLeastOfWhatIsFitted) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9), Found("stribeck", 1, 8),
                      Found("viscous_friction", -1, 7)};
  findings.effects[0].fitted = {0};
  findings.effects[0].removed_percent = 5;
  findings.effects[1].fitted = {1};
  findings.effects[1].removed_percent = -70;
  findings.effects[2].removed_percent = -90;  // a change since the reference
  findings.effects.push_back(Found("armature", 0, 6));
  findings.effects[3].fitted = {2};
  findings.effects[3].removed_percent = -80;
  findings.effects[3].evidence.confirmation = {50, 40};  // seen all the same
  const GapFigures little = Shrinking(-20, 30);
  EXPECT_TRUE(GiveUpWorst(little, true, &findings));
  EXPECT_THAT(Names(findings.unnamed), ElementsAre("stribeck@2"));
  EXPECT_TRUE(GiveUpWorst(little, true, &findings));
  EXPECT_FALSE(findings.without_name);
  EXPECT_TRUE(GiveUpWorst(little, true, &findings));
  EXPECT_TRUE(findings.without_name);
  EXPECT_FALSE(GiveUpWorst(little, true, &findings));
  EXPECT_THAT(Names(findings.effects), ElementsAre("viscous_friction@0"));
}

// Half of the gap, or nothing, is what short logs tell. What removes some of it
// for certain, and no more than half, has to be more certain itself.
TEST(GiveUpWorst, TakesNothingThatMayExplain) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9)};
  findings.effects[0].fitted = {0};
  findings.effects[0].probability = .71;
  EXPECT_FALSE(GiveUpWorst(Shrinking(1, 30), true, &findings));
  findings.effects[0].probability = .69;
  EXPECT_FALSE(GiveUpWorst(Shrinking(1, 60), true, &findings));
  GapFindings unlikely = findings;
  EXPECT_TRUE(GiveUpWorst(Shrinking(1, 30), true, &unlikely));
  EXPECT_FALSE(GiveUpWorst(Shrinking(-20, 60), true, &findings));
  EXPECT_FALSE(GiveUpWorst(GapFigures(), true, &findings));
  EXPECT_TRUE(GiveUpWorst(Shrinking(-60, -2), true, &findings));
}

// Without a reference a refit may have removed what the effect would have.
TEST(GiveUpWorst, TakesWithoutAReferenceWhatNothingSpeaksFor) {
  GapFindings findings;
  findings.effects = {Found("coulomb_friction", 1, 9)};
  findings.effects[0].fitted = {0};
  EXPECT_FALSE(GiveUpWorst(Shrinking(-2, 1), false, &findings));
  findings.effects[0].evidence.confirmation = {50, 40};
  EXPECT_FALSE(GiveUpWorst(Shrinking(-60, -2), false, &findings));
  findings.effects[0].evidence.confirmation = {50, 4};
  EXPECT_TRUE(GiveUpWorst(Shrinking(-60, -2), false, &findings));
}

// Fitted beside others it was possible; those that are claimed alone leave it
// to be what no arm has.
TEST(GiveUpImpossible, TakesWhatIsOnlyNowImpossible) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9), Found("torque_saturation", 1, 8)};
  findings.effects[0].fitted = {0};
  findings.effects[1].fitted = {1};
  EXPECT_FALSE(GiveUpImpossible(&findings));
  findings.effects[1].is_possible = false;
  findings.effects[1].evidence.confirmation = {50, 40};
  findings.effects[1].probability = .86;
  ASSERT_TRUE(GiveUpImpossible(&findings));
  EXPECT_THAT(Names(findings.effects), ElementsAre("spring@2"));
  EXPECT_THAT(Names(findings.unnamed), ElementsAre("torque_saturation@2"));
  EXPECT_LE(findings.unnamed[0].probability, .5);
  EXPECT_TRUE(findings.without_name);  // held-out data show something
  EXPECT_FALSE(GiveUpImpossible(&findings));
  findings.effects[0].estimates = {{"stiffness", "N m/rad", .012}};
  findings.effects[0].stddev_by_scale = {.0073};
  EXPECT_TRUE(GiveUpImpossible(&findings));
}

// A name for what left-out data do not show is at most as likely as not, and
// not told as one.
TEST(GiveUpWhatDoesNotHelp, WhereThereIsSomethingToRemove) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9), Found("stribeck", 1, 8),
                      Found("cable", 1, 7)};
  const std::vector<EffectGain> gains = {Gain(2), Gain(-.1), Gain(0)};
  for (int k = 0; k < 3; ++k) {
    FoundEffect& found = findings.effects[k];
    found.probability = .9;
    found.fitted = {k};
    found.gain = gains[k];
    found.removed_percent = 30 * gains[k].value;
  }
  findings.effects[1].evidence.confirmation = {50, 40};  // chi^2 has seen it
  GapFigures torque = Shrinking(-5, 40);
  torque.removed_percent = NAN;  // a refit leaves the noise
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
  GapFigures wide = Shrinking(-90, 80);  // data that tell little
  wide.removed_percent = torque.removed_percent = 20;
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(wide, &findings));
  findings.effects[1].gain.ci95[1] = 5;  // among what swings much more
  findings.effects[2].gain.ci95[1] = 5;
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
  findings.effects[1].gain = gains[1];
  findings.effects[2].gain = gains[2];
  EXPECT_TRUE(GiveUpWhatDoesNotHelp(torque, &findings));
  ASSERT_THAT(findings.unnamed, SizeIs(1));
  EXPECT_EQ(findings.unnamed[0].effect->name, "stribeck");
  EXPECT_EQ(findings.unnamed[0].probability, .5);
  EXPECT_TRUE(findings.without_name);
  EXPECT_TRUE(GiveUpWhatDoesNotHelp(torque, &findings));
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
  ASSERT_THAT(findings.effects, SizeIs(1));
  EXPECT_EQ(findings.effects[0].probability, .9);
}

// Joints say together that friction is another day's; each may say little.
TEST(GiveUpWhatDoesNotHelp, NotFrictionOfAnotherDay) {
  GapFindings findings;
  findings.effects = {Found("coulomb_friction", 1, 9)};
  findings.effects[0].fitted = {0};
  findings.effects[0].gain = Gain(-1);
  findings.effects[0].of_another_day = true;
  GapFigures torque = Shrinking(-3, 1);
  torque.removed_percent = -1;
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
}

// Which data that tell little cannot lead to: then it stays, as likely as not.
TEST(LowerWhatDoesNotHelp, WhereThereIsSomethingToRemove) {
  std::vector<FoundEffect> effects = {Found("spring", 1, 9),
                                      Found("stribeck", 1, 8)};
  for (FoundEffect& found : effects) found.probability = .9;
  effects[0].fitted = {0};
  effects[0].gain = Gain(2);
  effects[1].fitted = {1};
  effects[1].gain = Gain(-.1);
  GapFigures torque;
  torque.removed_percent = NAN;
  LowerWhatDoesNotHelp(torque, &effects);
  EXPECT_EQ(effects[1].probability, .9);
  torque.removed_percent = 57;
  LowerWhatDoesNotHelp(torque, &effects);
  EXPECT_EQ(effects[0].probability, .9);
  EXPECT_EQ(effects[1].probability, .5);
}

}  // namespace armcal::given_up_test
