#include "calib/diagnose/judge/evidence.h"

#include <gtest/gtest.h>

namespace armcal::evidence_test {

EffectEvidence Clear() {
  EffectEvidence evidence;
  evidence.odds = 8;
  evidence.strength = 7;
  evidence.confirmation = {500, 500};
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
  expect_less("stronger ones were needed", [](EffectEvidence* e) {
    e->chosen = 3;
    e->stronger = 2;
  });
  expect_less("a stronger one is on its joint", [](EffectEvidence* e) {
    e->beside = 1;
    e->stronger_beside = 1;
  });
  expect_less("held-out data do not care",
              [](EffectEvidence* e) { e->confirmation.explained = 0; });
  expect_less("held-out data hardly see it", [](EffectEvidence* e) {
    e->confirmation = {5, 5};
  });
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
  EffectEvidence alone;
  alone.odds = 8;
  alone.strength = 7;
  EffectEvidence beside_weaker = alone;
  beside_weaker.chosen = 3;
  beside_weaker.beside = 2;
  EXPECT_EQ(ProbabilityOf(alone), ProbabilityOf(beside_weaker));
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

}  // namespace armcal::evidence_test
