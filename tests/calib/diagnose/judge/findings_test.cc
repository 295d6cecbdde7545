#include "calib/diagnose/judge/findings.h"

#include <gmock/gmock.h>

#include "tests/fixtures/found_effect.h"

namespace armcal::findings_test {

using testing::ElementsAre;

std::vector<std::string> Sorted(std::vector<FoundEffect> effects) {
  SortFindings(&effects);
  return Names(effects);
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
