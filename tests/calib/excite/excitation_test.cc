#include "calib/excite/excitation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "problems/motion_information.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::excitation_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ModelParameters WithFriction(const Robot& robot) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset};
  options.transitions.assign(robot.num_joints(),
                             {{CoulombTransition::Law::kVelocity, .05}});
  return {robot, options};
}

DesignQuantities AllParameters(const ModelParameters& model) {
  const int m = model.size();
  DesignQuantities all{
      MatrixXd::Identity(m, m), MatrixXd::Zero(m, m), {}, VectorXd::Ones(m)};
  for (int k = 0; k < m; ++k) all.wanted.push_back(k);
  return all;
}

class ExcitationTest : public testing::Test {
 protected:
  explicit ExcitationTest(const char* name = "2R planar (vertical plane)")
      : robot_(SampleRobot(name)) {
    std::mt19937_64 random(2);
    SetRandomInertials(&random, &robot_);
    const int n = robot_.num_joints();
    options_.limits = {VectorXd::Constant(n, -2), VectorXd::Constant(n, 1),
                       VectorXd::Constant(n, 2), VectorXd::Constant(n, 6),
                       VectorXd::Constant(n, 300)};
    options_.torque_noise = VectorXd::Constant(n, .3);
    options_.harmonics = 6;
    options_.duration_s = 10;
  }

  Excitation Design(const DesignQuantities& quantities,
                    const ModelParameters& model) const {
    return DesignExcitation(robot_, model, quantities, options_);
  }

  Robot robot_;
  ExcitationOptions options_;
};

TEST_F(ExcitationTest, BeatsRandomMotionsWithinTheLimits) {
  const ModelParameters model = WithFriction(robot_);
  const DesignQuantities all = AllParameters(model);
  const Excitation designed = Design(all, model);
  EXPECT_TRUE(designed.converged) << designed.reason;
  EXPECT_LE(designed.used, 1);
  EXPECT_GT(designed.used, .9);
  MotionInformation information(robot_, model);
  const int samples = 96;
  const Motion units = designed.basis.Units(samples, 10. / samples);
  const VectorXd weight = VectorXd::Constant(2, 1000. / samples / .09);
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 300; ++k) {
    const MatrixXd numbers = RandomNumbers(
        designed.basis, units, {options_.limits, &options_.workspace},
        model.Values(robot_), 1000 + k, &information);
    ASSERT_GT(numbers.size(), 0);
    information.Evaluate(Combine(units, numbers), weight);
    MatrixXd gradient;
    best = std::min(best, EvaluateCriterion(ExcitationCriterion::kD, all,
                                            information.A(), &gradient)
                              .value());
  }
  EXPECT_LT(designed.criterion, best + std::log(.95));
}

// Viscous friction alone: the mean square of a velocity is at most its limit's.
TEST_F(ExcitationTest, ApproachesTheBoundOfOneParameter) {
  const ModelParameters model = WithFriction(robot_);
  DesignQuantities viscous = AllParameters(model);
  for (int k = 0; k < model.size(); ++k) {
    if (model.parameters()[k].name == "viscous[2]") viscous.wanted = {k};
  }
  ASSERT_EQ(viscous.wanted.size(), 1u);
  viscous.scale = VectorXd::Ones(1);
  // All else is known.
  viscous.known.diagonal().setConstant(1e9);
  viscous.known.row(viscous.wanted[0]).setZero();
  const Excitation designed = Design(viscous, model);
  const double bound = .3 / (2 * std::sqrt(1000));
  const double stddev = designed.stddev[viscous.wanted[0]];
  EXPECT_GT(stddev, bound);
  EXPECT_LT(stddev, 1.7 * bound);
}

TEST_F(ExcitationTest, TheSameAgain) {
  const ModelParameters model = WithFriction(robot_);
  const DesignQuantities all = AllParameters(model);
  EXPECT_EQ(Design(all, model).numbers, Design(all, model).numbers);
}

// Limits that gravity alone exceeds.
TEST_F(ExcitationTest, ImpossibleLimitsAreAResult) {
  options_.limits.effort.setConstant(1e-3);
  const ModelParameters model = WithFriction(robot_);
  const Excitation designed = Design(AllParameters(model), model);
  EXPECT_FALSE(designed.converged);
  EXPECT_EQ(designed.numbers.size(), 0);
  EXPECT_NE(designed.reason, "");
}

}  // namespace armcal::excitation_test
