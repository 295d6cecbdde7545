#include "model/dynamics/forward_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/rigid_arm.h"
#include "model/robot/kinematics.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::forward_dynamics_test {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Sample {
  Robot robot;
  VectorXd q, qd, qdd;

  explicit Sample(std::mt19937_64* random, int n)
      : robot(RandomArm(n, random)),
        q(UniformVector(random, n, -3, 3)),
        qd(UniformVector(random, n, -2, 2)),
        qdd(UniformVector(random, n, -5, 5)) {
    SetRandomInertials(random, &robot);
  }
};

TEST(ForwardDynamics, MassMatrixIsTheDifferenceOfInverseDynamics) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 70; ++run) {
    const int n = 1 + run % 7;
    const Sample s(&random, n);
    const MatrixXd M = MassMatrix(s.robot, s.q);
    for (int i = 0; i < n; ++i) {
      const VectorXd column =
          InverseDynamics(s.robot, s.q, s.qd, s.qdd + VectorXd::Unit(n, i)) -
          InverseDynamics(s.robot, s.q, s.qd, s.qdd);
      EXPECT_LT((M.col(i) - column).norm(), 1e-11 * (1 + M.norm())) << run;
    }
  }
}

// A fitted link may be no body: the joint still carries something.
TEST(ForwardDynamics, LinkInertiasAreThoseOfBodiesAndNeverNone) {
  std::mt19937_64 random(2);
  Sample s(&random, 3);
  for (Link& link : s.robot.links) link.joint.armature = .1;
  const VectorXd diagonal = MassMatrix(s.robot, s.q).diagonal();
  EXPECT_EQ(LinkInertias(s.robot, s.q), diagonal);
  s.robot.links[2].inertial = InertialParameters::FromVector(
      -.5 * s.robot.links[2].inertial.ToVector());
  const VectorXd fitted = MassMatrix(s.robot, s.q).diagonal();
  ASSERT_LT(fitted[2], 0);
  EXPECT_NEAR(LinkInertias(s.robot, s.q)[2], .05 * std::abs(fitted[2] + .1),
              1e-12);
}

// Spong, Hutchinson, Vidyasagar: see two_link_arm.h.
TEST(ForwardDynamics, TwoLinkArmOfTheTextbook) {
  const TwoLinkArm arm;
  const Robot robot = arm.ToRobot();
  for (double t = 0; t < 5; t += .37) {
    Vector2d q, qd, qdd;
    TwoLinkArm::Motion(t, &q, &qd, &qdd);
    const Vector2d found =
        ForwardDynamics(robot, q, qd, arm.Torque(q, qd, qdd));
    EXPECT_LT((found - qdd).norm(), 1e-10) << t;
    const Vector2d zero = Vector2d::Zero();
    EXPECT_LT((GravityTorque(robot, q) - arm.Torque(q, zero, zero)).norm(),
              1e-11);
  }
}

TEST(ForwardDynamics, UndoesInverseDynamicsWithArmature) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 70; ++run) {
    Sample s(&random, 1 + run % 7);
    VectorXd tau = InverseDynamics(s.robot, s.q, s.qd, s.qdd);
    for (int i = 0; i < s.robot.num_joints(); ++i) {
      s.robot.links[i].joint.armature = Uniform(&random, 0, .5);
      tau[i] += s.robot.links[i].joint.armature * s.qdd[i];
    }
    const VectorXd found = ForwardDynamics(s.robot, s.q, s.qd, tau);
    EXPECT_LT((found - s.qdd).norm(), 1e-8 * s.qdd.norm()) << run;
  }
}

TEST(ForwardDynamics, NothingToMoveIsNotANumber) {
  TwoLinkArm arm;
  arm.m2 = arm.I2 = 0;
  Robot robot = arm.ToRobot();
  const Vector2d q(.3, .4), zero = Vector2d::Zero();
  EXPECT_FALSE(ForwardDynamics(robot, q, zero, zero).allFinite());
  robot.links[1].joint.armature = .1;
  EXPECT_NEAR(ForwardDynamics(robot, q, zero, Vector2d(0, .2))[1], 2, 1e-12);
}

// d/dt of the energy along any motion is the power of its torque.
TEST(ForwardDynamics, EnergyChangesByThePower) {
  std::mt19937_64 random(3);
  for (int run = 0; run < 70; ++run) {
    const Sample s(&random, 1 + run % 7);
    const double h = 1e-4;
    const auto at = [&s](double t) {
      return Energy(s.robot, s.q + t * s.qd + t * t / 2 * s.qdd,
                    s.qd + t * s.qdd)
          .total();
    };
    const double rate =
        (at(-2 * h) - at(2 * h) + 8 * (at(h) - at(-h))) / (12 * h);
    const double power = InverseDynamics(s.robot, s.q, s.qd, s.qdd).dot(s.qd);
    EXPECT_NEAR(rate, power, 1e-6 * (1 + std::abs(power))) << run;
    EXPECT_NEAR(Energy(s.robot, s.q, s.qd).kinetic,
                .5 * s.qd.dot(MassMatrix(s.robot, s.q) * s.qd), 1e-10);
  }
}

// A point mass at (.3, 0, .4) of a link that turns about z of W, which is up.
TEST(ForwardDynamics, EnergyOfAPointMass) {
  Robot robot;
  robot.links.resize(1);
  robot.links[0].inertial = InertialParameters::FromCenterOfMass(
      2, Vector3d(.3, 0, .4), Eigen::Matrix3d::Zero());
  const ArmEnergy energy =
      Energy(robot, VectorXd::Constant(1, .7), VectorXd::Constant(1, 5));
  EXPECT_NEAR(energy.kinetic, .5 * 2 * 1.5 * 1.5, 1e-13);
  EXPECT_NEAR(energy.potential, 2 * 9.81 * .4, 1e-13);
}

// qdd of the terms is ForwardDynamics'; points move as kinematics says.
TEST(RigidArm, TermsAreTheArms) {
  std::mt19937_64 random(4);
  for (int run = 0; run < 30; ++run) {
    const int n = 2 + run % 6;
    const Sample s(&random, n);
    RigidArm arm(s.robot);
    const Attachment attachment = {1 + run % (n - 1), {.1, -.2, .3}};
    ArmTerms terms;
    arm.Evaluate(s.q, s.qd, {attachment}, &terms);
    EXPECT_LT((terms.mass_matrix * s.qdd + terms.bias -
               InverseDynamics(s.robot, s.q, s.qd, s.qdd))
                  .norm(),
              1e-10 * (1 + terms.mass_matrix.norm()));
    const double h = 1e-6;
    const auto pose = [&](double t) {
      return LinkPoses(s.robot, s.q + t * s.qd)[attachment.link];
    };
    const ArmTerms::Point& point = terms.points[0];
    const VectorXd twist = point.jacobian * s.qd;
    EXPECT_LT((point.X_WP.translation() - pose(0) * attachment.p_LP).norm(),
              1e-12);
    const Vector3d v =
        (pose(h) * attachment.p_LP - pose(-h) * attachment.p_LP) / (2 * h);
    EXPECT_LT((twist.tail<3>() - v).norm(), 1e-7);
    const Eigen::Matrix3d Rd = (pose(h).linear() - pose(-h).linear()) / (2 * h);
    const Eigen::Matrix3d W = Rd * pose(0).linear().transpose();
    EXPECT_LT((twist.head<3>() - Vector3d(W(2, 1), W(0, 2), W(1, 0))).norm(),
              1e-7);
  }
}

}  // namespace armcal::forward_dynamics_test
