#include "calib/diagnose/judge/agreement.h"

#include <gtest/gtest.h>

namespace armcal::agreement_test {

// Quantiles of chi squared: 5 degrees exceed 18.2 once in 370 times.
TEST(DisagreementTest, IsRealBeyondChance) {
  EXPECT_FALSE((Disagreement{17, 5}.IsReal(50, .2)));
  EXPECT_TRUE((Disagreement{20, 5}.IsReal(50, .2)));
}

// What the form of a large effect has wrong differs from joint to joint.
TEST(DisagreementTest, IsNoneWithinAnErrorOfForm) {
  EXPECT_FALSE((Disagreement{20, 5}.IsReal(1000, .2)));
}

TEST(DisagreementTest, OneJointCannotDisagree) {
  EXPECT_FALSE((Disagreement{100, 0}.IsReal(50, .2)));
}

}  // namespace armcal::agreement_test
