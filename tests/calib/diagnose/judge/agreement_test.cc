#include "calib/diagnose/judge/agreement.h"

#include <gtest/gtest.h>

namespace armcal::agreement_test {

// Quantiles of chi squared: 5 degrees exceed 18.2 once in 370 times.
TEST(AgreementTest, JointsDifferBeyondChance) {
  EXPECT_FALSE((Agreement{17, 5}.Differ(50, .2)));
  EXPECT_TRUE((Agreement{20, 5}.Differ(50, .2)));
}

// What the form of a large effect has wrong differs from joint to joint.
TEST(AgreementTest, JointsAgreeWithinAnErrorOfForm) {
  EXPECT_FALSE((Agreement{20, 5}.Differ(1000, .2)));
}

TEST(AgreementTest, OneJointCannotDiffer) {
  EXPECT_FALSE((Agreement{100, 0}.Differ(50, .2)));
}

// Of two that move, the other would have seen a clock that is wrong.
TEST(AgreementTest, OneOfSeveralJointsIsNotAll) {
  EXPECT_TRUE((Agreement{0, 0, 2, 1}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 2, 2}.IsOfOneJoint()));
  EXPECT_FALSE((Agreement{0, 0, 1, 1}.IsOfOneJoint()));
}

}  // namespace armcal::agreement_test
