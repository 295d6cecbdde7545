#include "calib/diagnose/judge/evidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::evidence_test {

EffectEvidence Clear() {
  EffectEvidence evidence;
  evidence.odds = 8;
  evidence.strength = 7;
  evidence.confirmation = {500, 500};
  evidence.least_share = 1;
  return evidence;
}

TEST(ProbabilityOf, IsHighForWhatIsClear) {
  EXPECT_GT(ProbabilityOf(Clear()), .95);
}

TEST(ProbabilityOf, FallsWithAllThatSpeaksAgainst) {
  const double clear = ProbabilityOf(Clear());
  const auto expect_less = [&](const char* what, auto change) {
    EffectEvidence evidence = Clear();
    change(&evidence);
    EXPECT_LT(ProbabilityOf(evidence), clear) << what;
  };
  expect_less("a near rival", [](EffectEvidence* e) { e->odds = 0; });
  expect_less("little explained", [](EffectEvidence* e) { e->strength = 3; });
  expect_less("more to come", [](EffectEvidence* e) { e->next = 60; });
  expect_less("stronger ones were needed",
              [](EffectEvidence* e) { e->stronger = 2; });
  expect_less("a stronger one is on its joint",
              [](EffectEvidence* e) { e->stronger_beside = 1; });
  expect_less("held-out data do not care",
              [](EffectEvidence* e) { e->confirmation.explained = 0; });
  expect_less("held-out data hardly see it", [](EffectEvidence* e) {
    e->confirmation = {5, 5};
  });
}

TEST(ProbabilityOf, FallsWithAllThatSpeaksAgainstAChangeSinceAReference) {
  EffectEvidence clear = Clear();
  clear.since_reference = true;
  const auto expect_less = [&](const char* what, auto change) {
    EffectEvidence evidence = clear;
    change(&evidence);
    EXPECT_LT(ProbabilityOf(evidence), ProbabilityOf(clear)) << what;
  };
  EXPECT_GT(ProbabilityOf(clear), .9);
  expect_less("a near rival", [](EffectEvidence* e) { e->odds = 0; });
  expect_less("little explained", [](EffectEvidence* e) { e->strength = 3; });
  expect_less("more to come", [](EffectEvidence* e) { e->next = 60; });
  expect_less("a stronger one", [](EffectEvidence* e) { e->stronger = 1; });
  expect_less("a third of the log does not have it",
              [](EffectEvidence* e) { e->least_share = 0; });
}

// What was held out has to say something: an effect that one stretch alone
// shows is as likely something that happened there.
TEST(ProbabilityOf, IsAtMostEvenWhereHeldOutDataCannotTell) {
  EffectEvidence evidence = Clear();
  evidence.held_out = true;
  EXPECT_EQ(ProbabilityOf(evidence), ProbabilityOf(Clear()));
  evidence.confirmation = {1e-9, 1e-9};
  EXPECT_LT(ProbabilityOf(evidence), .5);
}

// Weaker ones may be what its form has wrong, and are nothing against it.
TEST(ProbabilityOf, WeakerEffectsSayNothingAgainstARecordedOne) {
  EffectEvidence beside_weaker = Clear();
  beside_weaker.chosen = 3;
  EXPECT_EQ(ProbabilityOf(Clear()), ProbabilityOf(beside_weaker));
}

TEST(ProbabilityOf, AContactFeltByOneJointManyTimesIsNone) {
  EffectEvidence once = Clear();
  once.events = 1;
  once.one_joint = .3;
  EffectEvidence often = once;
  often.events = 8;
  EffectEvidence one_joint = once;
  one_joint.one_joint = 1;
  EXPECT_LT(ProbabilityOf(often), ProbabilityOf(once));
  EXPECT_LT(ProbabilityOf(one_joint), ProbabilityOf(once));
}

// Each window has to stand out for itself: as much of chi squared in eight of
// them is less, and eight times as much is the same.
TEST(ProbabilityBeyondOneReference, IsOfItsWindows) {
  EffectEvidence once = Clear();
  once.events = 1;
  once.one_joint = .3;
  EffectEvidence often = once;
  often.events = 8;
  EXPECT_LT(ProbabilityBeyondOneReference(often),
            ProbabilityBeyondOneReference(once));
  often.strength += std::log(8);
  EXPECT_NEAR(ProbabilityBeyondOneReference(often),
              ProbabilityBeyondOneReference(once), 1e-12);
  EffectEvidence one_joint = once;
  one_joint.one_joint = 1;
  EXPECT_LT(ProbabilityBeyondOneReference(one_joint),
            ProbabilityBeyondOneReference(once));
}

}  // namespace armcal::evidence_test
