#include "calib/gap_verdict.h"

#include <gtest/gtest.h>

namespace armcal {
namespace {

// Held-out mean squares in units of the floor.
GapFacts Facts(double nominal, double refit, double after) {
  GapFacts facts;
  facts.torque.nominal = nominal;
  facts.torque.refit = refit;
  facts.torque.after = after;
  return facts;
}

TEST(JudgeGap, WithoutEffects) {
  EXPECT_EQ(JudgeGap(Facts(1.1, 1, 1)), GapVerdict::kNoiseFloor);
  EXPECT_EQ(JudgeGap(Facts(5, 1.1, 1.1)), GapVerdict::kAbsorbed);
  // A refit that does not help has absorbed nothing.
  EXPECT_EQ(JudgeGap(Facts(5, 4.9, 4.9)), GapVerdict::kNoiseFloor);
}

TEST(JudgeGap, WhatHasNoNameIsUnknown) {
  GapFacts facts = Facts(5, 4, 4);
  facts.found_without_name = true;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  facts = Facts(5, 4, 4);
  facts.left_share = .9;
  facts.left = 1000;
  EXPECT_EQ(JudgeGap(facts), GapVerdict::kUnknown);
  // Chance gives as much.
  facts.left = 50;
  EXPECT_NE(JudgeGap(facts), GapVerdict::kUnknown);
}

// DESIGN.md: explained brings the gap to within 30 % of what is removable.
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

}  // namespace
}  // namespace armcal
