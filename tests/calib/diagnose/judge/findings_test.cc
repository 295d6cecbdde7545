#include "calib/diagnose/judge/findings.h"

#include <gmock/gmock.h>

#include "tests/fixtures/found_effect.h"

namespace armcal::findings_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

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

GapFigures Shrinking(double low, double high) {
  GapFigures torque;
  torque.ci95[0] = low;
  torque.ci95[1] = high;
  return torque;
}

// Which of several it is and whether it is one of them are two questions: what
// is left of both is that none of the catalogue is.
TEST(ShareTheRest, LeavesRoomForWhatHasNoName) {
  FoundEffect found = Found("added_mass", 5, 100);
  found.probability = .15;
  found.any_probability = .35;
  found.equivalent = {{FindEffect("payload"), -1, .3},
                      {FindEffect("spring"), 1, .1},
                      {FindEffect("cable"), 1, .01}};
  std::vector<PlacedEffect> candidates;
  ShareTheRest(&found, &candidates);
  ASSERT_EQ(candidates.size(), 3u) << "0.5 % is not worth a line";
  EXPECT_EQ(candidates[0].probability, .15);
  EXPECT_NEAR(candidates[1].probability, .2 * .3 / .41, 1e-12);
  EXPECT_NEAR(candidates[2].probability, .2 * .1 / .41, 1e-12);
  EXPECT_NEAR(found.equivalent[2].probability, .2 * .01 / .41, 1e-12);
}

TEST(ShareTheRest, EndsWhereNearlyAllIsTold) {
  FoundEffect found = Found("payload", -1, 100);
  found.probability = .9;
  found.any_probability = .94;
  found.equivalent = {{FindEffect("added_mass"), 1, .1}};
  std::vector<PlacedEffect> candidates;
  ShareTheRest(&found, &candidates);
  EXPECT_EQ(candidates.size(), 1u);
  FoundEffect contact = Found("external_contact", -1, 100);
  contact.probability = .7;
  ShareTheRest(&contact, &candidates);
  EXPECT_EQ(contact.any_probability, .7);
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

// A name for what left-out data do not show is at most as likely as not, and
// not told as one.
TEST(GiveUpWhatDoesNotHelp, WhereThereIsSomethingToRemove) {
  GapFindings findings;
  findings.effects = {Found("spring", 1, 9), Found("stribeck", 1, 8),
                      Found("cable", 1, 7)};
  const std::vector<double> removed = {60, -3, 0};
  for (int k = 0; k < 3; ++k) {
    FoundEffect& found = findings.effects[k];
    found.probability = .9;
    found.fitted = {k};
    found.removed_percent = removed[k];
  }
  findings.effects[1].evidence.confirmation = {50, 40};  // chi^2 has seen it
  GapFigures torque;
  torque.removed_percent = NAN;  // a refit leaves the noise
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
  torque.removed_percent = 57;
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

TEST(GiveUpWhatDoesNotHelp, IsOfAllThatIsRemovedWhereItIsTheOnlyOne) {
  GapFindings findings;
  findings.effects = {Found("link_inertia", 3, 40)};
  findings.effects[0].probability = .7;
  findings.effects[0].fitted = {0};
  findings.effects[0].removed_percent = 20;
  GapFigures torque;
  torque.removed_percent = -17;
  EXPECT_TRUE(GiveUpWhatDoesNotHelp(torque, &findings));
  EXPECT_THAT(findings.effects, IsEmpty());
  EXPECT_EQ(findings.unnamed[0].probability, .5);
  EXPECT_FALSE(findings.without_name);
}

// Joints say together that friction is another day's; each may say little.
TEST(GiveUpWhatDoesNotHelp, NotFrictionOfAnotherDay) {
  GapFindings findings;
  findings.effects = {Found("coulomb_friction", 1, 9)};
  findings.effects[0].fitted = {0};
  findings.effects[0].of_another_day = true;
  GapFigures torque;
  torque.removed_percent = -1;
  EXPECT_FALSE(GiveUpWhatDoesNotHelp(torque, &findings));
}

TEST(SortFindings, ByDeltaChi2) {
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
