#include "calib/diagnose/select/rivals.h"

#include <gtest/gtest.h>

namespace armcal::rivals_test {

// Of a joint's friction: all of it by a law of three parameters, and nearly all
// by a law of one.
TEST(LeaveOutErrorsOfForm, OfLawsThatAreNoBetterThanSimplerOnes) {
  std::vector<FittedRival> rivals = {{2, 1000, 20}, {2, 980, 7}, {2, 900, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 980);
  EXPECT_EQ(rivals[1].delta_chi2, 980);
  EXPECT_EQ(rivals[2].delta_chi2, 900);
}

TEST(LeaveOutErrorsOfForm, NotOfLawsThatAreBetter) {
  std::vector<FittedRival> rivals = {{2, 1000, 20}, {2, 960, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 1000);
}

// What is as simple is told apart by the data, and so are other joints and the
// whole robot.
TEST(LeaveOutErrorsOfForm, OfTheSameJointAndRicher) {
  std::vector<FittedRival> rivals = {
      {2, 1000, 20}, {2, 990, 20}, {1, 990, 7}, {-1, 990, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 1000);
  EXPECT_EQ(rivals[1].delta_chi2, 990);
}

}  // namespace armcal::rivals_test
