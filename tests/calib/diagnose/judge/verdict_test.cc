#include "calib/diagnose/judge/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::verdict_test {

// Held-out mean squares in units of the floor.
GapFacts Facts(double nominal, double refit, double after) {
  GapFacts facts;
  facts.torque.nominal = nominal;
  facts.torque.refit = refit;
  facts.torque.after = after;
  return facts;
}

TEST(UnexplainedOf, IsOrderedOrMuch) {
  JointLeft left{300, 400, NoiseFloor::kRepeats, true, 2};
  EXPECT_EQ(UnexplainedOf(left), 300);
  left.is_ordered = false;
  EXPECT_EQ(UnexplainedOf(left), 0);
  left.excess = 500;
  EXPECT_EQ(UnexplainedOf(left), 500);
  left.floor = NoiseFloor::kStandstill;
  EXPECT_EQ(UnexplainedOf(left), 0);
}

// Chi squared of 400 rows has a standard deviation of 28.
TEST(UnexplainedOf, IsNoChance) {
  EXPECT_EQ(UnexplainedOf({140, 400, NoiseFloor::kRepeats, true, 2}), 0);
  EXPECT_EQ(UnexplainedOf({143, 400, NoiseFloor::kRepeats, true, 2}), 143);
}

TEST(UnexplainedOf, IsThereAgainInWhatWasHeldOut) {
  JointLeft left{3000, 400, NoiseFloor::kRepeats, true, .9};
  EXPECT_EQ(UnexplainedOf(left), 0);
  left.held_out = 1.1;
  EXPECT_EQ(UnexplainedOf(left), 3000);
  // Where nothing was held out, or the joint does not move there.
  left.held_out = 0;
  EXPECT_EQ(UnexplainedOf(left), 3000);
  left.held_out = std::nan("");
  EXPECT_EQ(UnexplainedOf(left), 3000);
}

TEST(JudgeGap, WithoutEffects) {
  EXPECT_EQ(JudgeGap(Facts(1.1, 1, 1)), GapVerdict::kNoiseFloor);
  EXPECT_EQ(JudgeGap(Facts(5, 1.1, 1.1)), GapVerdict::kAbsorbed);
  // A refit that does not help has absorbed nothing.
  EXPECT_EQ(JudgeGap(Facts(1.9, 1.8, 1.8)), GapVerdict::kNoiseFloor);
  // What is held out is off by far more than noise, though what was fitted is
  // not: no agreement.
  EXPECT_EQ(JudgeGap(Facts(5, 4.9, 4.9)), GapVerdict::kUnknown);
  EXPECT_EQ(JudgeGap(Facts(50, 2.1, 2.1)), GapVerdict::kUnknown);
}

TEST(JudgeGap, WhatHasNoNameIsUnknown) {
  GapFacts facts = Facts(5, 1.9, 1.9);
  facts.found_without_name = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  facts = Facts(5, 1.9, 1.9);
  facts.left_share = .9;
  facts.left = 1000;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  facts.left = 0;
  EXPECT_NE(JudgeGap(facts), GapVerdict::kUnknown);
}

TEST(JudgeGap, NothingIsMissingFromAFileThatPredictsToTheNoise) {
  GapFacts facts = Facts(.99, 1.02, 1.02);
  facts.found_without_name = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kNoiseFloor);
  facts = Facts(1.02, 1.02, 1.02);
  facts.found_without_name = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
}

// Explained brings the gap to within 30 % of what is removable.
TEST(JudgeGap, ThirtyPercentMayBeLeft) {
  GapFacts facts = Facts(12, 11, 3.9);
  facts.effects = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kExplained);
  facts.torque.after = 4.1;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kPartlyExplained);
  facts.torque.after = 1.1;
  facts.left = 1000;
  facts.left_share = .2;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kExplained);
  facts.left_share = .4;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kPartlyExplained);
}

TEST(JudgeGap, NothingHeldOutIsNoAgreement) {
  GapFacts facts;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kNotTestable);
  facts.left_share = .9;
  facts.left = 1000;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  facts.since_reference = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kNotTestable);
  facts.found_without_name = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  facts.effects = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kPartlyExplained);
}

}  // namespace armcal::verdict_test
