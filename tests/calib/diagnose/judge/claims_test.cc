#include "calib/diagnose/judge/claims.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/found_effect.h"

namespace armcal::claims_test {

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
  held_out.after = 1.5;
  seen.scatter = {5, 1, 4};
  EXPECT_FALSE(IsThereWithoutName({seen, spoils}, held_out));
}

// A log that the model explains better than its noise lacks nothing there, and
// what is smaller than what the best of models lack is none.
TEST(IsNeeded, WhereThereIsMoreThanNoiseAndModelsLack) {
  FoundEffect found = Found("spring", 0, 10000);
  EXPECT_TRUE(IsNeeded(found, .25));
  found.gap = .8;
  EXPECT_TRUE(IsNeeded(found, .25));
  found.gap = .7;
  EXPECT_FALSE(IsNeeded(found, .25));
  EXPECT_TRUE(IsNeeded(found, 1)) << "noise that is hardly known";
  found.evidence.confirmation = {50, 40};
  EXPECT_TRUE(IsNeeded(found, .25)) << "small, and seen again";
  found.effect = Found("vibration", 0, 1).effect;
  EXPECT_FALSE(IsNeeded(found, .25)) << "of a phase of its own in each log";
  found.effect = Found("spring", 0, 1).effect;
  found.gap = 2;
  found.size = .0011;
  EXPECT_TRUE(IsNeeded(found, .25));
  found.size = .0009;
  EXPECT_FALSE(IsNeeded(found, .25));
}

// Friction of another day explains most of a joint's gap, and what its form has
// wrong looks like an effect there.
TEST(IsNeeded, WhereFrictionHasChangedWhatIsMoreThanItsForm) {
  FoundEffect found = Found("stribeck", 0, 100);
  found.over_change = .04;
  EXPECT_TRUE(IsNeeded(found, .25));
  found.over_change = .02;
  EXPECT_FALSE(IsNeeded(found, .25));
}

// By chi^2 where it would change, else by what is removed.
TEST(IsSeenAgain, ByChiSquaredOrByWhatIsRemoved) {
  FoundEffect found = Found("torque_saturation", 0, 1600);
  found.evidence.confirmation = {.04, .04};
  EXPECT_FALSE(IsSeenAgain(found));
  found.evidence.removes_gap = true;
  EXPECT_TRUE(IsSeenAgain(found));
  found.evidence.confirmation = {50, -20};
  EXPECT_FALSE(IsSeenAgain(found));
}

class IsClaimedTest : public testing::Test {
 protected:
  // chi^2 that held-out data should have of it, and have.
  bool Claimed(double probability, double gain, double expected = 500,
               double explained = 500) {
    found_.probability = probability;
    found_.evidence.gain.value = gain;
    found_.evidence.gain.ci95[0] = gain - .05;
    found_.evidence.confirmation = {expected, explained};
    return IsClaimed(found_);
  }

  FoundEffect found_ = Found("spring", 1, 50);
};

TEST_F(IsClaimedTest, WhatIsLikelierThanNot) {
  EXPECT_TRUE(Claimed(.5, -.1));
  EXPECT_FALSE(Claimed(.49, 1));
}

TEST_F(IsClaimedTest, WhatHeldOutDataDoNotShowIsLikelier) {
  EXPECT_FALSE(Claimed(.6, .01, 10, 2));
  EXPECT_TRUE(Claimed(.8, .01, 10, 2));
  EXPECT_FALSE(Claimed(.6, .01, 500, 50));
}

TEST_F(IsClaimedTest, WhatNothingAsksForIsLikelier) {
  found_.gap = 1.1;
  EXPECT_TRUE(Claimed(.6, .1));
  found_.gap = .9;
  EXPECT_FALSE(Claimed(.6, .1));
  EXPECT_TRUE(Claimed(.75, .1));
}

TEST_F(IsClaimedTest, WhatReferenceLogsDifferByIsNoChange) {
  found_.in_reference = {1, 50};
  EXPECT_FALSE(Claimed(.99, 1));
  found_.in_reference = {.7, 50};
  EXPECT_FALSE(Claimed(.99, 1));
  // Half a deviation is no word on that.
  found_.in_reference = {.7, .25};
  EXPECT_TRUE(Claimed(.99, 1));
  found_.in_reference = {0, 50};
  EXPECT_TRUE(Claimed(.99, 1));
  found_.scatter = {5, .3, 4};
  EXPECT_FALSE(Claimed(.99, 1));
  found_.scatter = {5, .1, 4};
  EXPECT_TRUE(Claimed(.99, 1));
}

TEST_F(IsClaimedTest, WhatHeldOutDataContradictIsNot) {
  EXPECT_FALSE(Claimed(.99, .01, 500, -20));
  // Its form is a little too large, and it helps.
  EXPECT_TRUE(Claimed(.99, .1, 500, -20));
  // Too little to tell.
  EXPECT_TRUE(Claimed(.99, -.01, 20, -10));
  // Less than a law's form is wrong by, of what was fitted.
  found_.delta_chi2 = 5000;
  EXPECT_TRUE(Claimed(.99, -.01, 500, -20));
  EXPECT_FALSE(Claimed(.99, -.01, 1500, -20));
}

TEST_F(IsClaimedTest, TouchesAreJudgedWhereTheyWere) {
  found_.contacts.resize(1);
  found_.estimates = {{"torque", "N m", -3}};
  found_.stddev = {1.7};
  EXPECT_FALSE(Claimed(.49, 1, 0, 0));
  EXPECT_TRUE(Claimed(.5, 0, 0, 0));
}

// Of a push of -3 +- 2 N m nobody knows which way it is.
TEST_F(IsClaimedTest, TouchesHaveASize) {
  found_.contacts.resize(1);
  found_.estimates = {{"torque", "N m", -3}};
  found_.stddev = {1.8};
  EXPECT_TRUE(Claimed(.9, 1));
  found_.stddev = {1.9};
  EXPECT_FALSE(Claimed(.9, 1));
}

TEST_F(IsClaimedTest, WhatSwingsInTimeHelps) {
  found_ = Found("vibration", 1, 50);
  EXPECT_TRUE(Claimed(.9, .01));
  EXPECT_FALSE(Claimed(.9, -.01));
}

// As of a load that is out of the tool's reach
// (Effects.PayloadsAreWithinReach).
TEST_F(IsClaimedTest, WhatARealArmCanHave) {
  found_ = Found("payload", -1, 50);
  EXPECT_TRUE(Claimed(.9, .1));
  found_.is_possible = false;
  EXPECT_FALSE(Claimed(.9, .1));
}

// What the arm does most of the time is no event.
TEST_F(IsClaimedTest, TouchesAreFewerThanWhatTheyStandOutFrom) {
  found_.contacts.resize(1);
  found_.estimates = {{"torque", "N m", -3}};
  found_.stddev = {.1};
  found_.share_of_time = .45;
  EXPECT_TRUE(Claimed(.9, 1));
  found_.share_of_time = .55;
  EXPECT_FALSE(Claimed(.9, 1));
}

// As what the state repeats looks so, too.
TEST_F(IsClaimedTest, NotWhatSwingsAsTheMotionDoes) {
  EXPECT_TRUE(Claimed(.9, .1));
  found_.of_motions_line = true;
  EXPECT_FALSE(Claimed(.9, .1));
}

// Nothing is known of a spring of .012 +- .0073 N m/rad with its neutral
// position at 4 +- 3 rad.
TEST_F(IsClaimedTest, EffectsHaveANumber) {
  found_.estimates = {{"stiffness", "N m/rad", .012}, {"neutral", "rad", 4}};
  found_.stddev_by_scale = {.0073, 3};
  EXPECT_FALSE(Claimed(.9, .1));
  found_.stddev_by_scale = {.006, 3};
  EXPECT_TRUE(Claimed(.9, .1));
  found_.stddev_by_scale = {.0073, 2};
  EXPECT_TRUE(Claimed(.9, .1));
  found_.stddev_by_scale = {.0073, 0};  // nothing tells of the second
  EXPECT_FALSE(Claimed(.9, .1));
  found_.stddev_by_scale = {0, 0};
  EXPECT_TRUE(Claimed(.9, .1));
}

// As it has no size there (swung_joints.h).
TEST_F(IsClaimedTest, NotOfADriveThatDoesNextToNothing) {
  EXPECT_TRUE(Claimed(.9, .1));
  found_.of_idle_drive = true;
  EXPECT_FALSE(Claimed(.9, .1));
}

// Two that data cannot tell apart are claimed together where one of them is
// probable enough; five would be a list and no name.
TEST(IsOneOfFew, WhereFewTogetherWouldBeClaimed) {
  FoundEffect found = Found("encoder_offset", 1, 100);
  found.fitted = {0};
  found.evidence.confirmation = {50, 40};
  found.probability = .4;
  found.any_probability = .6;
  EXPECT_FALSE(IsOneOfFew(found)) << "of itself alone";
  found.equivalent = {{FindEffect("base_tilt"), -1, .2}};
  EXPECT_TRUE(IsOneOfFew(found));
  EXPECT_FALSE(IsClaimed(found));
  found.any_probability = .45;
  EXPECT_FALSE(IsOneOfFew(found));
  found.any_probability = .6;
  found.evidence.confirmation = {50, 5};
  EXPECT_FALSE(IsOneOfFew(found)) << "held-out data do not show it";
  found.any_probability = .75;
  EXPECT_TRUE(IsOneOfFew(found));
  found.scatter = {100, 1, 99};
  EXPECT_FALSE(IsOneOfFew(found)) << "logs of the reference differ by as much";
  found.scatter = {};
  found.equivalent.resize(3, found.equivalent[0]);
  EXPECT_TRUE(IsOneOfFew(found));
  found.equivalent.resize(4, found.equivalent[0]);
  EXPECT_FALSE(IsOneOfFew(found));
}

}  // namespace armcal::claims_test
