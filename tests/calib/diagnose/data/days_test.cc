#include "calib/diagnose/data/days.h"

#include <gmock/gmock.h>
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

TEST_F(GapDaysTest, SoDoZerosOfTorques) {
  EXPECT_EQ(ZeroColumns(baseline_).size(), 6u);
}

// Six zeros of deviations .5 -.4 .3 -.6 .4 and the last one's.
class ZerosTest : public GapDaysTest {
 protected:
  VectorXd Zeros(double last) const {
    const double moved[] = {.5, -.4, .3, -.6, .4, last};
    VectorXd x = VectorXd::Zero(baseline_.size());
    for (const int c : ZeroColumns(baseline_)) {
      x[c] = moved[baseline_.columns()[c].joint];
    }
    return x;
  }
  int last() const { return ZeroColumns(baseline_).back(); }
};

// Student's t of five degrees at .0027 / 12 is 8.49 (tables of t: 6.87 at
// .0005, 9.68 at .00005), their root mean square .452.
TEST_F(ZerosTest, OneThatMovedFarMoreThanTheOthersDoIsTold) {
  EXPECT_THAT(BeyondTheOthers(baseline_, Zeros(3.5)), testing::IsEmpty());
  EXPECT_THAT(BeyondTheOthers(baseline_, Zeros(-4.2)),
              testing::ElementsAre(last()));
}

TEST_F(ZerosTest, SmallOnesAreNotWorthTelling) {
  EXPECT_EQ(NotableZeros(baseline_, Zeros(.1)).size(), 5u);
  EXPECT_EQ(NotableZeros(baseline_, Zeros(.5)).size(), 6u);
  EXPECT_THAT(NotableZeros(baseline_, VectorXd::Zero(baseline_.size())),
              testing::IsEmpty());
}

TEST_F(GapDaysTest, OneOrTwoJointsAreNoOtherDay) {
  EXPECT_FALSE(IsAnother(0));
  EXPECT_FALSE(IsAnother(2));
  EXPECT_TRUE(IsAnother(3));
}

// Viscous friction of all joints is down by so many standard deviations from
// day to day, each told to .3 of one.
class ChangedTogetherTest : public GapDaysTest {
 protected:
  std::vector<int> Changed(double each, int joints) const {
    VectorXd x = VectorXd::Zero(baseline_.size());
    for (const int c : DayColumns(baseline_)) {
      const BaselineColumn& column = baseline_.columns()[c];
      if (static_cast<JointTerm>(column.index) == JointTerm::kViscous &&
          column.joint < joints) {
        x[c] = -each;
      }
    }
    const MatrixXd covariance =
        .09 * MatrixXd::Identity(baseline_.size(), baseline_.size());
    return ChangedTogether(baseline_, JointTerm::kViscous, x, covariance);
  }
};

// Six that are down by 1.6 each are so once in 25 000 days; by 1, once in 90.
TEST_F(ChangedTogetherTest, SeveralThatChangeAlikeAreMoreThanEachIs) {
  EXPECT_EQ(Changed(1.6, 6).size(), 6u);
  EXPECT_TRUE(Changed(1, 6).empty());
}

TEST_F(ChangedTogetherTest, OneJointIsNotSeveral) {
  EXPECT_TRUE(Changed(9, 1).empty());
  EXPECT_EQ(Changed(4, 2).size(), 2u);
}

}  // namespace armcal::days_test
