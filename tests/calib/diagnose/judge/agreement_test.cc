#include "calib/diagnose/judge/agreement.h"

#include <gtest/gtest.h>

#include "tests/fixtures/diagnosed_arm.h"

namespace armcal::agreement_test {

// Quantiles of chi squared: 5 degrees exceed 18.2 once in 370 times.
TEST(AgreementTest, JointsDifferBeyondChance) {
  EXPECT_FALSE((Agreement{17, 50, 5}.Differ(.2)));
  EXPECT_TRUE((Agreement{20, 50, 5}.Differ(.2)));
}

// What the form of a large effect has wrong differs from joint to joint.
TEST(AgreementTest, JointsAgreeWithinAnErrorOfForm) {
  EXPECT_FALSE((Agreement{20, 1000, 5}.Differ(.2)));
}

TEST(AgreementTest, OneJointCannotDiffer) {
  EXPECT_FALSE((Agreement{100, 50, 0}.Differ(.2)));
}

// Of two that move, the other would have seen a clock that is wrong.
TEST(AgreementTest, OneOfSeveralJointsIsNotAll) {
  EXPECT_TRUE((Agreement{0, 0, 0, 2, 1}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 0, 2, 2}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 0, 1, 1}.IsOfOneJoint()));
}

// Of a few milliseconds a refit takes up all but what its prior says: it is
// seen by both joints nevertheless.
class AgreementOnTest : public DiagnosedArm<32> {};

TEST_F(AgreementOnTest, ADelayIsSeenGivenTheBaselinesOwn) {
  Add("delay", -1, {.006});
  const GapDiagnosis diagnosis = Diagnose(File());
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "delay");
  ExpectEstimate(diagnosis.effects[0], "delay", .006, .1);
}

// A column is a small delay's; what a large one differs from it by is no
// disagreement of joints.
TEST_F(AgreementOnTest, ALargeDelayIsSeenAlike) {
  Add("delay", -1, {.03});
  const GapDiagnosis diagnosis = Diagnose(File(), true);
  ASSERT_FALSE(diagnosis.effects.empty());
  EXPECT_EQ(diagnosis.effects[0].effect->name, "delay");
  EXPECT_TRUE(diagnosis.effects[0].joints_agree);
  ExpectEstimate(diagnosis.effects[0], "delay", .03, .1);
}

}  // namespace armcal::agreement_test
