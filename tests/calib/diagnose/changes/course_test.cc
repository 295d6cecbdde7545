#include "calib/diagnose/changes/course.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::course_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Course : public testing::Test {
 protected:
  VectorXd Of(const ChangeCourse& course) const {
    return CourseOf(course, times_, {});
  }

  const VectorXd times_ = (VectorXd(5) << 0, 1, 2, 4, 6).finished();
};

TEST_F(Course, RisesFromItsLogOn) {
  EXPECT_EQ(Of({ChangeForm::kStep, 2, 0}),
            (VectorXd(5) << 0, 0, 1, 1, 1).finished());
  EXPECT_EQ(Of({ChangeForm::kOnce, 2, 0}),
            (VectorXd(5) << 0, 0, 1, 0, 0).finished());
  EXPECT_TRUE(Of({ChangeForm::kDrift, 1, 0})
                  .isApprox((VectorXd(5) << 0, 0, .2, .6, 1).finished()));
}

// As a body warms with the time constant 6 / 4.
TEST_F(Course, SettlesByAnExponentialLaw) {
  const VectorXd settling = Of({ChangeForm::kDrift, 0, 1});
  EXPECT_EQ(settling[0], 0);
  EXPECT_DOUBLE_EQ(settling[4], 1);
  EXPECT_NEAR(settling[2], (1 - std::exp(-2 / 1.5)) / (1 - std::exp(-4.)),
              1e-12);
  EXPECT_GT(Of({ChangeForm::kDrift, 0, 2})[1], settling[1]);
}

// Twice the speed over the same way is four times the acceleration; the joints'
// speeds are all that differs.
TEST(MotionMeasures, AreLogarithmsBesideTheirMeans) {
  const MatrixXd speed = (MatrixXd(2, 2) << 1, 3, 2, 6).finished();
  const MatrixXd travel = (MatrixXd(2, 2) << .5, 4, .5, 4).finished();
  const MatrixXd measures = MotionMeasures({speed, travel, speed}, 0, 1);
  const VectorXd differences = measures.row(1) - measures.row(0);
  EXPECT_TRUE(differences.head(3).isApprox(
      Eigen::Vector3d(std::log(2), 0, std::log(4)), 1e-12));
  EXPECT_NEAR(std::abs(differences[3]), std::sqrt(2) * std::log(2), 1e-12);
  EXPECT_NEAR(measures.col(0).sum(), 0, 1e-12);
  EXPECT_EQ(CourseOf({ChangeForm::kMotion, 0, 2}, VectorXd::LinSpaced(2, 0, 1),
                     measures),
            measures.col(2));
}

// A joint at rest in one log is not infinitely slow, one at rest in all says
// nothing.
TEST(MotionMeasures, StandJointsAtRest) {
  const MatrixXd speed = (MatrixXd(2, 2) << 1, 0, 0, 0).finished();
  const MatrixXd measures = MotionMeasures({speed, speed, speed}, 0, 1);
  EXPECT_TRUE(measures.allFinite());
  EXPECT_NEAR(measures(0, 0) - measures(1, 0), std::log(1000), 1e-9);
}

// The same torques and more speed: it is the robot that has less friction.
TEST(MotionMeasures, AreNoneOfReplayedTorques) {
  const MatrixXd speed = (MatrixXd(3, 1) << 1, 1.2, 1.4).finished();
  const MatrixXd torque = (MatrixXd(3, 1) << 5, 5.01, 4.99).finished();
  EXPECT_EQ(MotionMeasures({speed, speed, torque}, 0, 0).cols(), 0);
  EXPECT_EQ(MotionMeasures({speed, speed, speed}, 0, 0).cols(),
            kMotionMeasures);
}

}  // namespace armcal::course_test
