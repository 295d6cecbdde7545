#include "model/plant/simbody_arm.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/robot/kinematics.h"
#include "model/text/input_error.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::simbody_arm_test {

// Torques of a random state.
void ExpectOurTorque(const Robot& robot, SimbodyArm* arm,
                     std::mt19937_64* random) {
  const int n = robot.num_joints();
  const Eigen::VectorXd q = UniformVector(random, n, -3, 3);
  const Eigen::VectorXd qd = UniformVector(random, n, -2, 2);
  const Eigen::VectorXd qdd = UniformVector(random, n, -5, 5);
  const Eigen::VectorXd tau = InverseDynamics(robot, q, qd, qdd);
  EXPECT_LT((arm->InverseDynamics(q, qd, qdd) - tau).norm(),
            1e-12 * (1 + tau.norm()));
}

// That this runs at all in a Release build is the regression test of Debian's
// Simbody with NDEBUG, which ends in a segmentation fault (CMakeLists.txt).
TEST(SimbodyArm, InverseDynamicsIsOursForRandomArms) {
  std::mt19937_64 random(1);
  for (int run = 0; run < 100; ++run) {
    Robot robot = RandomArm(1 + run % 7, &random);
    SetRandomInertials(&random, &robot);
    SimbodyArm arm(robot);
    ExpectOurTorque(robot, &arm, &random);
  }
}

// Also of robots that branch.
TEST(SimbodyArm, DynamicsAreOursForRandomTrees) {
  std::mt19937_64 random(4);
  for (int run = 0; run < 100; ++run) {
    const Robot robot = RandomTree(2 + run % 11, run, &random);
    SimbodyArm arm(robot);
    ExpectOurTorque(robot, &arm, &random);
    const Eigen::VectorXd q = UniformVector(&random, robot.num_joints(), -3, 3);
    const Eigen::MatrixXd M = MassMatrix(robot, q);
    EXPECT_LT((arm.MassMatrix(q) - M).norm(), 1e-12 * (1 + M.norm()));
  }
}

TEST(SimbodyArm, TermsGiveTheSameTorque) {
  std::mt19937_64 random(2);
  Robot robot = SampleRobot("Panda 7R");
  SetRandomInertials(&random, &robot);
  SimbodyArm arm(robot);
  const Eigen::VectorXd q = UniformVector(&random, 7, -2, 2);
  const Eigen::VectorXd qd = UniformVector(&random, 7, -2, 2);
  const Eigen::VectorXd qdd = UniformVector(&random, 7, -5, 5);
  ArmTerms terms;
  arm.Evaluate(q, qd, {}, &terms);
  const Eigen::VectorXd tau = arm.InverseDynamics(q, qd, qdd);
  EXPECT_LT((terms.mass_matrix * qdd + terms.bias - tau).norm(), 1e-11);
}

// Poses are those of our kinematics; velocities their differences.
TEST(SimbodyArm, AttachmentsMoveWithTheirLinks) {
  std::mt19937_64 random(3);
  const Robot robot = SampleRobot("SCARA RRPR");
  Robot heavy = robot;
  SetRandomInertials(&random, &heavy);
  SimbodyArm arm(heavy);
  const Eigen::VectorXd q = UniformVector(&random, 4, -1, 1);
  const Eigen::VectorXd qd = UniformVector(&random, 4, -1, 1);
  const std::vector<Attachment> attachments = {
      {2, Eigen::Vector3d(.1, .2, .3)}, {3, Eigen::Vector3d(-.1, 0, .2)}};
  ArmTerms terms;
  arm.Evaluate(q, qd, attachments, &terms);
  const double h = 1e-6;
  const auto before = LinkPoses(robot, q - h * qd);
  const auto at = LinkPoses(robot, q);
  const auto after = LinkPoses(robot, q + h * qd);
  for (int k = 0; k < 2; ++k) {
    const auto& [link, p_LP] = attachments[k];
    const ArmTerms::Point& point = terms.points[k];
    EXPECT_TRUE(point.X_WP.linear().isApprox(at[link].linear(), 1e-12));
    EXPECT_LT((point.X_WP.translation() - at[link] * p_LP).norm(), 1e-12);
    const Eigen::VectorXd twist = point.jacobian * qd;
    const Eigen::Vector3d v =
        (after[link] * p_LP - before[link] * p_LP) / (2 * h);
    EXPECT_LT((twist.tail<3>() - v).norm(), 1e-8);
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(
        after[link].linear() * before[link].linear().transpose()));
    const Eigen::Vector3d w = turn.axis() * turn.angle() / (2 * h);
    EXPECT_LT((twist.head<3>() - w).norm(), 1e-7);
  }
}

Robot Pendulum(double mass, double length) {
  Robot robot;
  Link link;
  link.name = "rod";
  // The joint's axis is y of W; the mass hangs along -z.
  link.X_PF.linear() =
      Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  link.inertial = InertialParameters::FromCenterOfMass(
      mass, Eigen::Vector3d(0, length, 0), Eigen::Matrix3d::Zero());
  robot.links.push_back(link);
  return robot;
}

// Of 60 degrees: 4 sqrt(l / g) K(sin 30 deg), K(.5) = 1.685750354812596.
TEST(SimbodyArm, SwingHasThePendulumsPeriod) {
  SimbodyArm arm(Pendulum(2, .7));
  const double period = 4 * std::sqrt(.7 / 9.81) * 1.685750354812596;
  Eigen::VectorXd q = Eigen::VectorXd::Constant(1, M_PI / 3);
  Eigen::VectorXd qd = Eigen::VectorXd::Zero(1);
  EXPECT_NEAR(arm.PotentialEnergy(q), -2 * 9.81 * .7 * .5, 1e-12);
  ASSERT_TRUE(arm.Swing(period, 1e-10, 100000, &q, &qd));
  EXPECT_NEAR(q[0], M_PI / 3, 1e-7);
  EXPECT_NEAR(qd[0], 0, 1e-6);
  ASSERT_TRUE(arm.Swing(period / 4, 1e-10, 100000, &q, &qd));
  EXPECT_NEAR(q[0], 0, 1e-7);
  EXPECT_NEAR(arm.KineticEnergy(q, qd), 2 * 9.81 * .7 * .5, 1e-6);
}

TEST(SimbodyArm, RefusalNamesTheLink) {
  Robot robot = Pendulum(2, .7);
  // The published third link of the PUMA 560, whose Iyy exceeds Ixx + Izz.
  robot.links[0].inertial = InertialParameters::FromCenterOfMass(
      4.8, Eigen::Vector3d(0, 0, .07),
      Eigen::Vector3d(.066, .086, .0125).asDiagonal().toDenseMatrix());
  EXPECT_THAT([&] { SimbodyArm arm(robot); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("link rod: Simbody cannot simulate it")));
}

}  // namespace armcal::simbody_arm_test
