#include "calib/inspect/joint_zero.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "calib/inspect/log_reading.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::joint_zero_test {

using testing::HasSubstr;

class JointZeroTest : public testing::Test {
 protected:
  std::string Doubt() const {
    const UniformSeries series(arm_.log, .01, .05, 8);
    const auto findings = DoubtJointZeros(
        arm_.robot, SamplesAs(LogReading(arm_.robot), arm_.robot, series, 400));
    return findings.empty() ? "" : findings[0].sentence;
  }
  void Scale(double factor) {
    for (Link& link : arm_.robot.links) {
      link.inertial.mass *= factor;
      link.inertial.first_moment *= factor;
      link.inertial.inertia *= factor;
    }
  }
  InspectedArm arm_;
};

TEST_F(JointZeroTest, ARightFileIsNotDoubted) {
  EXPECT_EQ(Doubt(), "");
  // Nor one whose masses are off.
  Scale(1.6);
  arm_.robot.links[3].inertial.first_moment *= 1.5;
  EXPECT_EQ(Doubt(), "");
}

TEST_F(JointZeroTest, AJointThatTurnsTheOtherWay) {
  for (Eigen::MatrixXd* x :
       {&arm_.log.q, &arm_.log.qd, &arm_.log.qdd, &arm_.log.tau}) {
    x->col(2) *= -1;
  }
  EXPECT_THAT(Doubt(), HasSubstr("joint3 turns the other way"));
  // Of masses of another arm no zero tells.
  Scale(10);
  EXPECT_EQ(Doubt(), "");
}

TEST_F(JointZeroTest, AZeroThatIsAQuarterOrHalfOfATurnAway) {
  arm_.log.q.col(2).array() -= M_PI / 2;
  EXPECT_THAT(Doubt(), HasSubstr("joint3 has its zero 90 degrees away"));
  arm_.log.q.col(2).array() -= M_PI / 2;
  EXPECT_THAT(Doubt(), HasSubstr("joint3 has its zero 180 degrees away"));
}

}  // namespace armcal::joint_zero_test
