#include "calib/diagnose/judge/evidence.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::evidence_test {

EffectEvidence Clear() {
  EffectEvidence evidence;
  evidence.odds = evidence.odds_of_any = 8;
  evidence.strength = 7;
  evidence.confirmation = {500, 500};
  evidence.least_share = 1;
  return evidence;
}

// Felt once, by several joints.
EffectEvidence Touch() {
  EffectEvidence once = Clear();
  once.events = 1;
  once.one_joint = .3;
  return once;
}
EffectEvidence OfOneJoint(EffectEvidence touch) {
  touch.one_joint = 1;
  return touch;
}
EffectEvidence Often(EffectEvidence touch) {
  touch.events = 8;
  return touch;
}

template <typename Change>
void ExpectLess(const char* what, const EffectEvidence& clear, Change change) {
  EffectEvidence evidence = clear;
  change(&evidence);
  EXPECT_LT(ProbabilityOf(evidence), ProbabilityOf(clear)) << what;
}
// With a reference or without.
void ExpectRivalsToCount(const EffectEvidence& clear) {
  ExpectLess("a near rival", clear, [](EffectEvidence* e) { e->odds = 0; });
  ExpectLess("little explained", clear,
             [](EffectEvidence* e) { e->strength = 3; });
  ExpectLess("more to come", clear, [](EffectEvidence* e) { e->next = 60; });
}

TEST(ProbabilityOf, IsHighForWhatIsClear) {
  EXPECT_GT(ProbabilityOf(Clear()), .95);
}

TEST(ProbabilityOf, FallsWithAllThatSpeaksAgainst) {
  const EffectEvidence clear = Clear();
  ExpectRivalsToCount(clear);
  ExpectLess("stronger ones were needed", clear,
             [](EffectEvidence* e) { e->stronger = 2; });
  ExpectLess("a stronger one is on its joint", clear,
             [](EffectEvidence* e) { e->stronger_beside = 1; });
  ExpectLess("held-out data do not care", clear,
             [](EffectEvidence* e) { e->confirmation.explained = 0; });
  ExpectLess("held-out data hardly see it", clear, [](EffectEvidence* e) {
    e->confirmation = {5, 5};
  });
}

TEST(ProbabilityOf, FallsWithAllThatSpeaksAgainstAChangeSinceAReference) {
  EffectEvidence clear = Clear();
  clear.since_reference = true;
  EXPECT_GT(ProbabilityOf(clear), .9);
  ExpectRivalsToCount(clear);
  ExpectLess("a stronger one", clear,
             [](EffectEvidence* e) { e->stronger = 1; });
  ExpectLess("a third of the log does not have it", clear,
             [](EffectEvidence* e) { e->least_share = 0; });
}

// What was held out has to say something: an effect that one stretch alone
// shows is as likely something that happened there.
// An equal rival speaks against the one and not against the two.
TEST(ProbabilityOfAny, IsNotLessForWhatCannotBeToldApart) {
  EffectEvidence evidence = Clear();
  evidence.odds = 0;
  evidence.odds_of_any = Clear().odds;
  EXPECT_LT(ProbabilityOf(evidence), ProbabilityOf(Clear()));
  EXPECT_EQ(ProbabilityOfAny(evidence), ProbabilityOf(Clear()));
}

// However strong a finding is, of two causes that fit it as well each has half
// of its probability: friction of a joint that turned one way only is an offset
// as well.
TEST(ProbabilityOf, IsAShareOfWhatCannotBeToldApart) {
  for (const bool since_reference : {false, true}) {
    EffectEvidence evidence = Clear();
    evidence.since_reference = since_reference;
    evidence.odds = 0;
    evidence.share_of_any = .5;
    evidence.strength = 12;
    EXPECT_GT(ProbabilityOfAny(evidence), .95);
    EXPECT_DOUBLE_EQ(ProbabilityOf(evidence), ProbabilityOfAny(evidence) / 2);
  }
}

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
  const double once = ProbabilityOf(Touch());
  EXPECT_LT(ProbabilityOf(Often(Touch())), once);
  EXPECT_LT(ProbabilityOf(OfOneJoint(Touch())), once);
}

// Each window has to stand out for itself: as much of chi squared in eight of
// them is less, and eight times as much is the same.
TEST(ProbabilityBeyondOneReference, IsOfItsWindows) {
  const double once = ProbabilityBeyondOneReference(Touch());
  EffectEvidence often = Often(Touch());
  EXPECT_LT(ProbabilityBeyondOneReference(often), once);
  often.strength += std::log(8);
  EXPECT_NEAR(ProbabilityBeyondOneReference(often), once, 1e-12);
  EXPECT_LT(ProbabilityBeyondOneReference(OfOneJoint(Touch())), once);
}

}  // namespace armcal::evidence_test
