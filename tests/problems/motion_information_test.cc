#include "problems/motion_information.h"

#include <gtest/gtest.h>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::motion_information_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class MotionInformationTest : public testing::Test {
 protected:
  MotionInformationTest() : robot_(SampleRobot("SCARA RRPR")) {
    SetRandomInertials(&random_, &robot_);
    ModelParameters::Options options;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(4, {{CoulombTransition::Law::kVelocity, .5}});
    model_.emplace(robot_, options);
    information_.emplace(robot_, *model_);
    for (MatrixXd* x : {&motion_.q, &motion_.qd, &motion_.qdd}) {
      *x = UniformVector(&random_, 20, -1, 1).reshaped(5, 4);
    }
    weight_ = UniformVector(&random_, 4, .5, 2);
    x_ = UniformVector(&random_, model_->size(), -1, 1);
  }

  std::mt19937_64 random_{4};
  Robot robot_;
  std::optional<ModelParameters> model_;
  std::optional<MotionInformation> information_;
  Motion motion_;
  VectorXd weight_, x_;
};

// Of the rigid arm, against recursive Newton-Euler.
TEST_F(MotionInformationTest, TorqueIsInverseDynamics) {
  information_->Evaluate(motion_, weight_);
  const MatrixXd tau = information_->Torque(model_->Values(robot_));
  for (int s = 0; s < motion_.size(); ++s) {
    const VectorXd expected = InverseDynamics(
        robot_, motion_.q.row(s), motion_.qd.row(s), motion_.qdd.row(s));
    EXPECT_LT((tau.row(s).transpose() - expected).norm(), 1e-12);
  }
}

// x' A x is the weighted sum of squares of x's torques.
TEST_F(MotionInformationTest, InformationIsThatOfTheTorques) {
  information_->Evaluate(motion_, weight_);
  const double squares =
      information_->Torque(x_).colwise().squaredNorm().dot(weight_);
  EXPECT_NEAR(x_.dot(information_->A() * x_), squares, 1e-12 * squares);
}

TEST_F(MotionInformationTest, GradientIsThatOfAAndTheTorque) {
  const int m = model_->size();
  MatrixXd of_A = UniformVector(&random_, m * m, -1, 1).reshaped(m, m);
  of_A = (of_A + of_A.transpose()).eval();
  const MatrixXd of_torque = UniformVector(&random_, 20, -1, 1).reshaped(5, 4);
  const auto value = [&](const Motion& motion) {
    information_->Evaluate(motion, weight_);
    return information_->A().cwiseProduct(of_A).sum() +
           information_->Torque(x_).cwiseProduct(of_torque).sum();
  };
  value(motion_);
  MotionGradient gradient(motion_);
  information_->AddGradient(of_A, x_, of_torque, &gradient);
  constexpr double h = 1e-5;
  const auto check = [&](MatrixXd Motion::*part, const MatrixXd& found) {
    for (int s = 0; s < 5; ++s) {
      for (int j = 0; j < 4; ++j) {
        Motion plus = motion_, minus = motion_;
        (plus.*part)(s, j) += h;
        (minus.*part)(s, j) -= h;
        EXPECT_NEAR(found(s, j), (value(plus) - value(minus)) / (2 * h), 1e-4);
      }
    }
  };
  check(&Motion::q, gradient.q);
  check(&Motion::qd, gradient.qd);
  check(&Motion::qdd, gradient.qdd);
}

}  // namespace armcal::motion_information_test
