// Steps of model/simd/motion/rollout_kernel.h, by the classes that offer them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "model/dynamics/arm_stepper.h"
#include "model/dynamics/batch_rollout.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/rigid_arm.h"
#include "model/plant/simbody_arm.h"
#include "tests/fixtures/exact_rollout.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::rollout_kernel_test {

using Eigen::VectorXd;
using Law = CoulombTransition::Law;

class RolloutKernel : public testing::TestWithParam<const simd::Kernels*> {
 protected:
  // One window under a constant torque.
  RolloutStates Run(const RolloutArm& arm, const VectorXd& q,
                    const VectorXd& qd, const VectorXd& tau, double step,
                    long steps) const {
    RolloutStates states{q.transpose(), qd.transpose(), {}, {}};
    BatchRollout({arm}, *GetParam())
        .Run(
            0, step, steps,
            [&](const BatchRollout::Batch& at, double* begin, double* end) {
              for (int j = 0; j < tau.size(); ++j) {
                begin[j * at.stride] = end[j * at.stride] = tau[j];
              }
            },
            nullptr, &states);
    return states;
  }
};
INSTANTIATE_TEST_SUITE_P(InstructionSets, RolloutKernel,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

VectorXd Number(double x) { return VectorXd::Constant(1, x); }

// A rod that turns about a horizontal axis comes back after
// 4 K(sin(q0 / 2)) sqrt(I / (m g l)).
TEST_P(RolloutKernel, PendulumHasItsPeriod) {
  Robot robot;
  robot.links.resize(1);
  robot.gravity = {9.81, 0, 0};  // along x, where the rod points at q = 0
  const double m = 2, l = .3, I = .25, q0 = 2;
  robot.links[0].inertial.mass = m;
  robot.links[0].inertial.first_moment = {m * l, 0, 0};
  robot.links[0].inertial.inertia = Eigen::Vector3d(.1, I, I).asDiagonal();
  const double period =
      4 * std::comp_ellint_1(std::sin(q0 / 2)) * std::sqrt(I / (m * 9.81 * l));
  const RolloutStates end = Run({robot, {}, {}}, Number(q0), Number(0),
                                Number(0), period / 2000, 2000);
  EXPECT_NEAR(end.q(0, 0), q0, 1e-9);
  EXPECT_NEAR(end.qd(0, 0), 0, 1e-8);
}

// Half the step, a sixteenth of the error; of the energy, too.
TEST_P(RolloutKernel, IsOfOrderFour) {
  std::mt19937_64 random(1);
  const RolloutArm arm{ArmWithFrames(4, 2, &random), {}, {}};
  const VectorXd q = UniformVector(&random, 4, -2, 2);
  const VectorXd qd = UniformVector(&random, 4, -1, 1);
  const VectorXd none = VectorXd::Zero(4);
  RigidArm readable(arm.robot);
  const VectorXd exact = ExactEnd(arm, q, qd, none, .3, &readable).head(4);
  const double energy = Energy(arm.robot, q, qd).total();
  double error[2], drift[2];
  for (const int k : {0, 1}) {
    const int steps = 100 << k;
    const RolloutStates end = Run(arm, q, qd, none, .3 / steps, steps);
    error[k] = (end.q.row(0).transpose() - exact).norm();
    drift[k] = std::abs(Energy(arm.robot, end.q.row(0), end.qd.row(0)).total() -
                        energy);
  }
  EXPECT_LT(error[0], 1e-4);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 4, .3);
  EXPECT_GT(std::log2(drift[0] / drift[1]), 3.5);
}

// All that joints add, against adaptive steps of Simbody's links and the laws
// as joint_term.h writes them: of order 3.
TEST_P(RolloutKernel, JointTermsAreTheirs) {
  std::mt19937_64 random(2);
  for (const Law law : {Law::kVelocity, Law::kDisplacement}) {
    RolloutArm arm{ArmWithFrames(4, 1, &random), {}, {}};
    for (Link& link : arm.robot.links) {
      Joint& joint = link.joint;
      joint.viscous = Uniform(&random, 1, 5);
      joint.coulomb = Uniform(&random, 1, 5);
      joint.offset = Uniform(&random, -1, 1);
      joint.armature = Uniform(&random, .1, 1);
      arm.transitions.push_back({law, law == Law::kVelocity ? .2 : .02});
      arm.springs.push_back({Uniform(&random, 5, 20), .3});
    }
    const VectorXd q = UniformVector(&random, 4, -2, 2);
    const VectorXd qd = UniformVector(&random, 4, .5, 1);
    const VectorXd tau = UniformVector(&random, 4, -5, 5);
    SimbodyArm simbody(arm.robot);
    const VectorXd exact = ExactEnd(arm, q, qd, tau, .25, &simbody);
    double error[2];
    for (const int k : {0, 1}) {
      const RolloutStates end = Run(arm, q, qd, tau, 1e-3 / (1 << k), 250 << k);
      error[k] = (end.q.row(0).transpose() - exact.head(4)).norm() +
                 (end.qd.row(0).transpose() - exact.segment(4, 4)).norm();
      if (law == Law::kDisplacement) {
        EXPECT_LT((end.coulomb.row(0).transpose() - exact.tail(4)).norm(),
                  1e-4);
      }
    }
    EXPECT_LT(error[0], law == Law::kVelocity ? 2e-6 : 2e-5);
    if (law == Law::kVelocity) {
      EXPECT_GT(std::log2(error[0] / error[1]), 2.5);
    }
  }
}

// Of a linear law x' = A x an implicit step is its rational function
//   (1 - z^2 / 8 - z^3 / 48) / (1 - z / 4)^4,  z = h A,
// e^z up to order 3, 0 for what is infinitely fast (Hairer, Wanner, IV.7).
TEST_P(RolloutKernel, ImplicitStepsHaveTheirStabilityFunction) {
  const double m = .5, h = 1e-2, b = 200;
  Robot robot = HorizontalSlide(m);
  robot.links[0].joint.viscous = b;
  for (const double k : {0., 3e3, 1e6}) {
    Eigen::Matrix2d z, one = Eigen::Matrix2d::Identity();
    z << 0, h, -h * k / m, -h * b / m;
    if (k == 0) z(0, 1) = 0;  // the velocity alone
    const Eigen::Matrix2d root = (one - z / 4).inverse(), square = root * root;
    const Eigen::Vector2d expected = (one - z * z / 8 - z * z * z / 48) *
                                     square * square * Eigen::Vector2d(.3, 2);
    const RolloutStates end =
        Run({robot, {}, {{k, 0}}}, Number(.3), Number(2), Number(0), h, 1);
    EXPECT_NEAR(k > 0 ? end.q(0, 0) : .3, expected[0], 1e-12);
    EXPECT_NEAR(end.qd(0, 0), expected[1], 1e-10);
  }
}

// Light blocks on slides; explicit steps of a millisecond would diverge.
TEST_P(RolloutKernel, StiffJointsStayStable) {
  Robot robot = HorizontalSlide(1e-4);
  Joint& joint = robot.links[0].joint;
  // m v' = F - b v, a thousand times faster than the step.
  joint.viscous = 100;
  RolloutStates end =
      Run({robot, {}, {}}, Number(0), Number(0), Number(7), 1e-3, 100);
  EXPECT_NEAR(end.qd(0, 0), 7. / 100, 1e-6);
  EXPECT_NEAR(end.q(0, 0), 7. / 100 * .1, 1e-3 * 7 / 100);
  // Dry friction stops it, and lets it slide at F = C tanh(v / w).
  joint.viscous = 0;
  joint.coulomb = 5;
  const CoulombTransition tanh{Law::kVelocity, .02};
  end = Run({robot, {tanh}, {}}, Number(0), Number(.5), Number(3), 1e-3, 200);
  EXPECT_NEAR(end.qd(0, 0), .02 * std::atanh(3. / 5), 1e-6);
  // A Prandtl element holds it at F w / C, once that is damped.
  joint.viscous = .5;
  const CoulombTransition prandtl{Law::kDisplacement, 1e-4};
  end =
      Run({robot, {prandtl}, {}}, Number(.3), Number(0), Number(3), 1e-3, 200);
  EXPECT_NEAR(end.q(0, 0) - .3, 3 * 1e-4 / 5, 1e-9);
  EXPECT_NEAR(end.coulomb(0, 0), 3. / 5, 1e-6);
  // Above what it holds it slides at v = (F - C) / b.
  end = Run({robot, {prandtl}, {}}, Number(0), Number(0), Number(6), 1e-3, 200);
  EXPECT_NEAR(end.qd(0, 0), (6. - 5) / .5, 1e-6);
  EXPECT_EQ(end.coulomb(0, 0), 1);
  // A spring of 1e4 N/m, damped.
  joint.coulomb = 0;
  end = Run({robot, {}, {{1e4, .1}}}, Number(0), Number(0), Number(20), 1e-3,
            200);
  EXPECT_NEAR(end.q(0, 0), .1 + 20 / 1e4, 1e-6);
}

TEST_P(RolloutKernel, TorqueIsLinearWithinAStep) {
  const Robot robot = HorizontalSlide(2);
  ArmStepper block({robot, {}, {}}, *GetParam());
  block.SetState(Number(0), Number(0));
  // m x'' = a t: x = a t^3 / 6 m, exact for the method.
  EXPECT_TRUE(block.Advance(.5, Number(0), Number(3)));
  EXPECT_NEAR(block.q()[0], 6. * .125 / 12, 1e-15);
  EXPECT_NEAR(block.qd()[0], 6. * .25 / 4, 1e-15);
  EXPECT_FALSE(block.Advance(.5, Number(0), Number(std::nan(""))));
  EXPECT_EQ(block.q()[0], 0);
}

}  // namespace armcal::rollout_kernel_test
