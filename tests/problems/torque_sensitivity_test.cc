#include "problems/torque_sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/inverse_dynamics.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::torque_sensitivity_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Law = CoulombTransition::Law;

// A PUMA with viscous and Coulomb friction, along a short motion.
class Puma : public testing::Test {
 protected:
  Puma() : robot_(SampleRobot("PUMA560 6R")) {
    SetRandomInertials(&random_, &robot_);
    for (Link& link : robot_.links) {
      link.joint.viscous = Uniform(&random_, .5, 2);
      link.joint.coulomb = Uniform(&random_, .5, 2);
    }
    motion_ =
        MakeTrajectory(RecordMotion(RandomMultisine(&random_, 6), .2, .01));
  }
  ModelParameters Model(CoulombTransition transition) const {
    ModelParameters::Options options;
    options.geometry = GeometryKnowledge::kNonzeroLengths;
    options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb};
    options.transitions.assign(6, {transition});
    return ModelParameters(robot_, options);
  }
  // Newton-Euler with friction by velocity.
  VectorXd Torque(const VectorXd& s, double width) const {
    VectorXd tau =
        InverseDynamics(robot_, s.head(6), s.segment(6, 6), s.tail(6));
    for (int j = 0; j < 6; ++j) {
      const Joint& joint = robot_.links[j].joint;
      tau[j] += joint.viscous * s[6 + j] +
                joint.coulomb * std::tanh(s[6 + j] / width);
    }
    return tau;
  }
  VectorXd State(int k) const {
    VectorXd s(18);
    s << motion_.q.row(k).transpose(), motion_.qd.row(k).transpose(),
        motion_.qdd.row(k).transpose();
    return s;
  }

  std::mt19937_64 random_{7};
  Robot robot_;
  Trajectory motion_;
};

TEST_F(Puma, DerivativesAreThoseOfNewtonEuler) {
  const double width = .3;
  const ModelParameters model = Model({Law::kVelocity, width});
  const VectorXd x = model.Values(robot_);
  TorqueSensitivity sensitivity(model);
  sensitivity.Enter(motion_);
  MatrixXd U, T;
  for (int k = 0; k < motion_.size(); k += 5) {
    const VectorXd s = State(k);
    sensitivity.Regress(k, &U);
    EXPECT_LT((U * x - Torque(s, width)).norm(), 1e-10);
    sensitivity.Differentiate(k, x, &T);
    for (int c = 0; c < 18; ++c) {
      const VectorXd step = 1e-4 * VectorXd::Unit(18, c);
      const VectorXd central =
          (Torque(s + step, width) - Torque(s - step, width)) / 2e-4;
      EXPECT_LT((T.col(c) - central).norm(), 2e-4 * (1 + central.norm())) << c;
    }
  }
}

// c = tanh(qd / w): d c / d log w = -(qd / w) (1 - c^2).
TEST_F(Puma, WidthsOfFrictionByVelocity) {
  const double width = .3;
  const ModelParameters model = Model({Law::kVelocity, width});
  TorqueSensitivity sensitivity(model);
  sensitivity.Enter(motion_);
  ASSERT_EQ(sensitivity.num_widths(), 6);
  for (int w = 0; w < 6; ++w) {
    const int j = sensitivity.width_joint(w);
    const ModelParameter& p =
        model.parameters()[sensitivity.width_parameter(w)];
    EXPECT_EQ(p.block, j);
    EXPECT_EQ(p.term, JointTerm::kCoulomb);
    const double s = motion_.qd(3, j) / width;
    EXPECT_NEAR(sensitivity.WidthDerivative(3, w),
                -s / std::pow(std::cosh(s), 2), 2e-3);
  }
}

// The state of displacement friction is frozen: no slope by velocity.
TEST_F(Puma, FrictionByDisplacementKeepsItsState) {
  const ModelParameters model = Model({Law::kDisplacement, .01});
  TorqueSensitivity sensitivity(model);
  sensitivity.Enter(motion_);
  MatrixXd with, without;
  VectorXd x = model.Values(robot_);
  sensitivity.Differentiate(9, x, &with);
  for (int w = 0; w < 6; ++w) x[sensitivity.width_parameter(w)] = 0;
  sensitivity.Differentiate(9, x, &without);
  EXPECT_LT((with - without).norm(), 1e-6 * without.norm());
}

}  // namespace armcal::torque_sensitivity_test
