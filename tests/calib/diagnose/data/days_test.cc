#include "calib/diagnose/data/days.h"

#include <gtest/gtest.h>

#include "tests/fixtures/sample_robots.h"

namespace armcal::days_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class GapDaysTest : public testing::Test {
 protected:
  GapDaysTest() : baseline_(Frictional(), {}, VectorXd::Ones(6)) {
    baseline_.FreeDays();
  }
  static Robot Frictional() {
    Robot robot = SampleRobot("PUMA560 6R");
    for (Link& link : robot.links) {
      link.joint.viscous = 1;
      link.joint.coulomb = 2;
    }
    return robot;
  }
  // Friction of the first `joints` differs by 6 of standard deviations of .1.
  bool IsAnother(int joints) const {
    VectorXd x = VectorXd::Zero(baseline_.size());
    for (const int c : DayColumns(baseline_)) {
      if (baseline_.columns()[c].joint < joints) x[c] = -.6;
    }
    const MatrixXd covariance =
        .01 * MatrixXd::Identity(baseline_.size(), baseline_.size());
    return IsAnotherDay(baseline_, x, covariance);
  }

  GapBaseline baseline_;
};

TEST_F(GapDaysTest, ViscousAndCoulombFrictionDifferFromDayToDay) {
  EXPECT_EQ(DayColumns(baseline_).size(), 12u);
}

TEST_F(GapDaysTest, OneOrTwoJointsAreNoOtherDay) {
  EXPECT_FALSE(IsAnother(0));
  EXPECT_FALSE(IsAnother(2));
  EXPECT_TRUE(IsAnother(3));
}

}  // namespace armcal::days_test
