#include "calib/gap_findings.h"

#include <gmock/gmock.h>

#include "model/effects/effects.h"

namespace armcal {
namespace {

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

TEST(IsClaimed, WhatIsLikelyOrHelps) {
  FoundEffect found = Found("spring", 1, 50);
  const auto claimed = [&found](double probability, double gain) {
    found.probability = probability;
    found.evidence.gain = gain;
    return IsClaimed(found);
  };
  EXPECT_TRUE(claimed(.5, -.1));
  EXPECT_TRUE(claimed(.3, .01));
  EXPECT_FALSE(claimed(.49, 0));
  EXPECT_FALSE(claimed(.29, 1));
  found.contacts.resize(1);
  EXPECT_FALSE(claimed(.49, 1));
  EXPECT_TRUE(claimed(.5, 0));
  found = Found("vibration", 1, 50);
  EXPECT_TRUE(claimed(.9, .01));
  EXPECT_FALSE(claimed(.9, -.01));
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

}  // namespace
}  // namespace armcal
