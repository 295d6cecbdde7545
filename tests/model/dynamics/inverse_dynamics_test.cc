#include "model/dynamics/inverse_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/robot/kinematics.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/two_link_arm.h"

namespace armcal::inverse_dynamics_test {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;

Link MakeLink(JointType type, const Isometry3d& X_PF, double mass,
              const Vector3d& com, const Matrix3d& inertia) {
  Link link;
  link.joint.type = type;
  link.X_PF = X_PF;
  link.inertial = InertialParameters::FromCenterOfMass(mass, com, inertia);
  return link;
}

VectorXd V(std::initializer_list<double> values) {
  VectorXd v(values.size());
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

// A pendulum about the horizontal y axis of the world, hanging along -z at
// q = 0: tau = (I + m l^2) qdd + m g l sin q.
TEST(InverseDynamics, Pendulum) {
  const double m = 2, l = .3, I = .04, g = 9.81;
  Isometry3d X_PF = Isometry3d::Identity();
  X_PF.linear() << 0, -1, 0, 0, 0, 1, -1, 0, 0;  // x down, z along y of W
  X_PF.translation() << 1, 2, 3;
  Robot robot;
  robot.gravity = {0, 0, -g};
  robot.links = {MakeLink(JointType::kRevolute, X_PF, m, {l, 0, .1},
                          Vector3d(.01, .04, I).asDiagonal())};
  for (const double q : {-2.0, 0.0, .5, 3.0}) {
    EXPECT_NEAR(InverseDynamics(robot, V({q}), V({1.5}), V({-.7}))[0],
                (I + m * l * l) * -.7 + m * g * l * std::sin(q), 1e-12);
  }
}

TEST(InverseDynamics, TwoLinkArmOfTheTextbook) {
  const TwoLinkArm arm;
  const Robot robot = arm.ToRobot();
  for (double t = 0; t < 5; t += .37) {
    Vector2d q, qd, qdd;
    TwoLinkArm::Motion(t, &q, &qd, &qdd);
    const Vector2d error =
        InverseDynamics(robot, q, qd, qdd) - arm.Torque(q, qd, qdd);
    EXPECT_LT(error.norm(), 1e-11) << t;
  }
}

TEST(InverseDynamics, LiftOfTwoMasses) {
  Robot robot;
  robot.gravity = {0, 0, -9.81};
  for (const double m : {3.0, 2.0}) {
    robot.links.push_back(MakeLink(JointType::kPrismatic,
                                   Isometry3d::Identity(), m, {.1, .2, .3},
                                   Matrix3d::Identity()));
  }
  // The second slides on the first: its acceleration is the sum.
  const VectorXd tau =
      InverseDynamics(robot, V({.3, 1}), V({5, -2}), V({.5, .25}));
  EXPECT_NEAR(tau[0], 3 * (.5 + 9.81) + 2 * (.75 + 9.81), 1e-12);
  EXPECT_NEAR(tau[1], 2 * (.75 + 9.81), 1e-12);
}

// A bead at r on a horizontal rod that turns by q1 about the vertical:
// tau1 = (I + m r^2) q1'' + 2 m r r' q1', f2 = m (r'' - r q1'^2).
TEST(InverseDynamics, BeadOnATurningRod) {
  const double m = 1.7, I = .2;
  Isometry3d along_x = Isometry3d::Identity();
  along_x.linear() =
      Eigen::AngleAxisd(kPi / 2, Vector3d::UnitY()).toRotationMatrix();
  Robot robot;
  robot.links = {
      MakeLink(JointType::kRevolute, Isometry3d::Identity(), 1, {0, 0, 0},
               Vector3d(.1, .1, I).asDiagonal()),
      MakeLink(JointType::kPrismatic, along_x, m, {0, 0, 0}, Matrix3d::Zero())};
  const double r = .6, rd = -.8, rdd = .3, w = 2, wd = -1.1;
  const VectorXd tau =
      InverseDynamics(robot, V({.9, r}), V({w, rd}), V({wd, rdd}));
  EXPECT_NEAR(tau[0], (I + m * r * r) * wd + 2 * m * r * rd * w, 1e-12);
  EXPECT_NEAR(tau[1], m * (rdd - r * w * w), 1e-12);
}

// A rotor of spin rate s and axial inertia C in a gimbal of rate w: the gimbal
// axis needs no torque, but the turntable under it, held, C s w.
TEST(InverseDynamics, GyroscopicMoment) {
  const double C = .3, A = .2, spin = 40, w = 2;
  Isometry3d X = Isometry3d::Identity();  // z of F is x of P
  X.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  Robot robot;
  robot.gravity.setZero();
  const Matrix3d none = Matrix3d::Zero();
  robot.links = {MakeLink(JointType::kRevolute, Isometry3d::Identity(), 1,
                          {0, 0, 0}, none),
                 MakeLink(JointType::kRevolute, X, 1, {0, 0, 0}, none),
                 MakeLink(JointType::kRevolute, X, 1, {0, 0, 0},
                          Vector3d(A, A, C).asDiagonal())};
  // Spin axis: y of W at q = 0, turned about x by q2.
  const double q2 = .4;
  const VectorXd tau =
      InverseDynamics(robot, V({0, q2, .8}), V({0, w, spin}), V({0, 0, 0}));
  // H = C s (0, cos q2, sin q2) + A w x; dH/dt along z is C s w cos q2.
  EXPECT_NEAR(tau[0], C * spin * w * std::cos(q2), 1e-12);
  EXPECT_NEAR(tau[1], 0, 1e-12);
  EXPECT_NEAR(tau[2], 0, 1e-12);
}

// Kinetic and potential energy from poses alone; velocities of the links by
// central differences of order 4.
double SumOfEnergies(const Robot& robot, const VectorXd& q,
                     const VectorXd& qd) {
  const double h = 1e-3;
  const auto X = LinkPoses(robot, q);
  std::vector<std::vector<Isometry3d>> near;
  for (const int k : {-2, -1, 1, 2})
    near.push_back(LinkPoses(robot, q + k * h * qd));
  const auto rate = [h](const auto& m2, const auto& m1, const auto& p1,
                        const auto& p2) {
    return ((m2 - p2 + 8 * (p1 - m1)) / (12 * h)).eval();
  };
  double energy = 0;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const InertialParameters& body = robot.links[i].inertial;
    const Vector3d com = body.first_moment / body.mass;
    const Vector3d v = rate(near[0][i] * com, near[1][i] * com,
                            near[2][i] * com, near[3][i] * com);
    const Matrix3d Rd = rate(near[0][i].linear(), near[1][i].linear(),
                             near[2][i].linear(), near[3][i].linear());
    const Matrix3d W = X[i].linear().transpose() * Rd;  // in L, skew
    const Vector3d w(W(2, 1), W(0, 2), W(1, 0));
    const Matrix3d I =
        body.inertia - body.mass * (com.squaredNorm() * Matrix3d::Identity() -
                                    com * com.transpose());
    energy += .5 * body.mass * v.squaredNorm() + .5 * w.dot(I * w) -
              body.mass * robot.gravity.dot(X[i] * com);
  }
  return energy;
}

// The work of the joints is the change of energy, on arms of all kinds.
TEST(InverseDynamics, WorkIsTheChangeOfEnergy) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 12; ++trial) {
    const int n = 1 + trial % 6;
    Robot robot = RandomArm(n, &random);
    SetRandomInertials(&random, &robot);
    const VectorXd a = UniformVector(&random, n, -1, 1);
    const VectorXd w = UniformVector(&random, n, 1, 3);
    const auto q = [&](double t) -> VectorXd {
      return a.array() * (w.array() * t).sin();
    };
    const auto qd = [&](double t) -> VectorXd {
      return a.array() * w.array() * (w.array() * t).cos();
    };
    const auto qdd = [&](double t) -> VectorXd {
      return -a.array() * w.array().square() * (w.array() * t).sin();
    };
    const int steps = 400;
    const double end = 1.3, dt = end / steps;
    double work = 0;  // Simpson's rule
    for (int k = 0; k <= steps; ++k) {
      const double t = k * dt;
      const double weight = k == 0 || k == steps ? 1 : k % 2 ? 4 : 2;
      work += weight * dt / 3 *
              InverseDynamics(robot, q(t), qd(t), qdd(t)).dot(qd(t));
    }
    const double change = SumOfEnergies(robot, q(end), qd(end)) -
                          SumOfEnergies(robot, q(0), qd(0));
    EXPECT_NEAR(work, change, 1e-7 * (1 + std::abs(change))) << trial;
  }
}

}  // namespace armcal::inverse_dynamics_test
