#include "model/plant/closed_loop.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/dynamics/forward_dynamics.h"
#include "model/dynamics/inverse_dynamics.h"
#include "model/dynamics/rigid_arm.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::closed_loop_test {

using Eigen::VectorXd;

Robot Puma() {
  std::mt19937_64 random(2);
  Robot robot = SampleRobot("PUMA560 6R");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) link.joint.armature = .3;
  return robot;
}

ClosedLoopRun RunPuma(const SimulatedRobot& robot, const Robot& model,
                      ClosedLoopOptions options, double duration = 4) {
  MotionOptions motion;
  motion.duration = duration;
  const ReferenceMotion reference = FourierMotion(model, motion);
  const auto rate = options.sensors.log_rate_hz;
  options.controller = DefaultController(model, reference.at(0).q, 8);
  options.sensors.log_rate_hz = rate;
  SimbodyArm arm(robot.robot);
  return RunClosedLoop(robot, model, reference, options, &arm);
}

SimulatedRobot Plain(const Robot& robot) {
  SimulatedRobot plant;
  plant.robot = robot;
  return plant;
}

// A perfect model and exact sensors: the torque is that of our inverse dynamics
// along the motion, which Simbody's dynamics then follows.
TEST(ClosedLoop, TorqueIsInverseDynamicsOfTheMotion) {
  const Robot robot = Puma();
  const ClosedLoopRun run = RunPuma(Plain(robot), robot, {});
  MotionOptions motion;
  motion.duration = 4;
  const ReferenceMotion reference = FourierMotion(robot, motion);
  ASSERT_EQ(run.log.size(), 1001);
  // Held torques come half a control period late.
  EXPECT_LT(run.tracking_rms.maxCoeff(), 3e-4);
  EXPECT_GE(run.tracking_peak, run.tracking_rms.maxCoeff());
  EXPECT_LT(run.tracking_peak, 5e-3);
  for (int k = 300; k < 750; k += 20) {
    const ReferencePoint point = reference.at(run.log.t[k]);
    VectorXd tau = InverseDynamics(robot, point.q, point.qd, point.qdd);
    tau += .3 * point.qdd;
    EXPECT_LT((run.log.tau.row(k).transpose() - tau).norm(), 5e-3 * tau.norm())
        << k;
  }
}

TEST(ClosedLoop, SameSeedSameBitsAndSeedsDiffer) {
  const Robot robot = Puma();
  ClosedLoopOptions options;
  options.sensors.encoder_noise = VectorXd::Constant(6, 1e-5);
  options.sensors.torque_noise = VectorXd::Constant(6, .1);
  options.sensors.coloured_noise = VectorXd::Constant(6, .1);
  const ClosedLoopRun a = RunPuma(Plain(robot), robot, options, 1);
  const ClosedLoopRun b = RunPuma(Plain(robot), robot, options, 1);
  EXPECT_EQ(a.log.q, b.log.q);
  EXPECT_EQ(a.log.tau, b.log.tau);
  options.sensors.seed = 1;
  EXPECT_NE(RunPuma(Plain(robot), robot, options, 1).log.q, a.log.q);
}

// Halving the step changes the log by less than a fine encoder resolves.
TEST(ClosedLoop, StepIsFineEnough) {
  const Robot robot = Puma();
  SimulatedRobot plant = Plain(robot);
  for (int j = 0; j < 6; ++j) {
    plant.joint_laws.push_back(
        {j, VectorXd(), true,
         [j](const ArmInstant& at, const double*, double*) {
           const double v = at.velocity[j];
           return -2 * v - 3 * v / std::hypot(v, .005);
         }});
  }
  ClosedLoopOptions options;
  const ClosedLoopRun coarse = RunPuma(plant, robot, options);
  options.step = 5e-4;
  const ClosedLoopRun fine = RunPuma(plant, robot, options);
  const Eigen::MatrixXd dq = coarse.log.q - fine.log.q;
  const Eigen::MatrixXd dtau = coarse.log.tau - fine.log.tau;
  for (int j = 0; j < 6; ++j) {
    EXPECT_LT(std::sqrt(dq.col(j).squaredNorm() / dq.rows()), 1e-6) << j;
    EXPECT_LT(dtau.col(j).norm(), 1e-3 * fine.log.tau.col(j).norm()) << j;
  }
}

TEST(ClosedLoop, LimitsHoldAndTheIntegralDoesNotWindUp) {
  const Robot robot = Puma();
  MotionOptions motion;
  motion.duration = 2;
  const ReferenceMotion reference = FourierMotion(robot, motion);
  ClosedLoopOptions options;
  options.controller = DefaultController(robot, reference.at(0).q, 8);
  options.controller.drives[1].torque_limit = 5;
  SimbodyArm arm(robot);
  const SimulatedRobot plant = Plain(robot);
  const ClosedLoopRun run =
      RunClosedLoop(plant, robot, reference, options, &arm);
  EXPECT_LE(run.log.tau.col(1).cwiseAbs().maxCoeff(), 5);
  EXPECT_GT(run.saturated_share, .2);
}

// The same motion, two samples later.
TEST(ClosedLoop, CommandsArriveAsLateAsAsked) {
  const Robot robot = Puma();
  MotionOptions motion;
  motion.duration = 2;
  const ReferenceMotion reference = FourierMotion(robot, motion);
  ClosedLoopOptions options;
  options.controller = DefaultController(robot, reference.at(0).q, 8);
  RigidArm arm(robot);
  const SimulatedRobot plant = Plain(robot);
  const Log on_time = RunClosedLoop(plant, robot, reference, options, &arm).log;
  options.controller.delay = .008;
  const Log late = RunClosedLoop(plant, robot, reference, options, &arm).log;
  EXPECT_EQ(late.qref, on_time.qref);
  for (int k = 50; k < 500; k += 50) {
    EXPECT_LT((late.q.row(k) - on_time.q.row(k - 2)).norm(), 1e-9) << k;
  }
}

// A motor that is asked for all it has: behind its lag T the acceleration is
// a (1 - exp(-t / T)), which is integrated twice.
TEST(ClosedLoop, TorqueFollowsItsLag) {
  Robot robot = Puma();
  robot.links.resize(1);
  robot.gravity.setZero();
  const double T = .05, inertia = MassMatrix(robot, VectorXd::Zero(1))(0, 0) +
                                  robot.links[0].joint.armature;
  ReferenceMotion jump;
  jump.duration = 1;
  jump.at = [](double t) {
    const VectorXd zero = VectorXd::Zero(1);
    return ReferencePoint{VectorXd::Constant(1, t > 0 ? 1e6 : 0), zero, zero};
  };
  ClosedLoopOptions options;
  options.controller.drives.resize(1);
  options.controller.drives[0].kp = 1;
  options.controller.drives[0].torque_limit = 3;
  options.controller.drives[0].lag = T;
  options.controller.feedforward = Feedforward::kNone;
  RigidArm arm(robot);
  const Log log = RunClosedLoop(Plain(robot), robot, jump, options, &arm).log;
  for (int k = 1; k < log.size(); k += 20) {
    const double t = log.t[k] - 1e-3;  // the jump is seen a period late
    const double way = t * t / 2 - T * t + T * T * (1 - std::exp(-t / T));
    EXPECT_NEAR(log.q(k, 0), 3 / inertia * way, 1e-6 * (1 + way)) << k;
  }
}

TEST(ClosedLoop, TorquesOfTheLogAreAsOldAsAsked) {
  const Robot robot = Puma();
  ClosedLoopOptions options;
  const ClosedLoopRun on_time = RunPuma(Plain(robot), robot, options);
  options.sensors.torque_delay = .008;  // two samples
  const ClosedLoopRun late = RunPuma(Plain(robot), robot, options);
  for (int k = 500; k < 900; k += 50) {
    EXPECT_NEAR(late.log.tau(k, 1), on_time.log.tau(k - 2, 1), 1e-9);
  }
}

TEST(ClosedLoop, PassiveJointsAreNeitherDrivenNorLogged) {
  Robot robot = Puma();
  SimulatedRobot plant = Plain(robot);
  Link base;
  base.name = "base";
  base.joint.type = JointType::kPrismatic;
  base.X_PF.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()).matrix();
  base.X_ML.linear() = base.X_PF.linear().transpose();
  base.inertial.mass = 50;
  plant.robot.links.insert(plant.robot.links.begin(), base);
  plant.num_passive = 1;
  plant.joint_laws.push_back(
      {0, VectorXd(), false, [](const ArmInstant& at, const double*, double*) {
         return -1e6 * at.position[0] - 1e4 * at.velocity[0];
       }});
  const ClosedLoopRun run = RunPuma(plant, robot, {}, 2);
  EXPECT_EQ(run.log.q.cols(), 6);
  EXPECT_TRUE(run.finite);
  EXPECT_LT(run.tracking_rms.maxCoeff(), 1e-2);
}

// Behind a gear of 2e4 N m/rad the link hangs back by what the gear carries:
// of the second joint, from the motor's torque while it rests. Where nothing
// yields, links are where the motors are, and no one is told.
TEST(ClosedLoop, LinksAreBehindGearsThatYield) {
  constexpr double kStiffness = 2e4, kDamping = 50;
  const Robot robot = Puma();
  SimulatedRobot plant = Plain(robot);
  plant.transmissions.push_back(
      {1,
       {},
       [](double x, double rate, const double*, double*) {
         return kStiffness * x + kDamping * rate;
       },
       [](double load) { return load / kStiffness; }});
  const ClosedLoopRun run = RunPuma(plant, robot, {}, 1);
  ASSERT_EQ(run.link_position.rows(), run.log.size());
  ASSERT_EQ(run.link_position.cols(), 6);
  const double deflection = run.log.q(0, 1) - run.link_position(0, 1);
  EXPECT_GT(std::abs(deflection), 1e-4);
  EXPECT_NEAR(deflection, run.log.tau(0, 1) / kStiffness,
              .02 * std::abs(deflection));
  EXPECT_EQ(run.link_position.col(2), run.log.q.col(2));
  EXPECT_EQ(RunPuma(Plain(robot), robot, {}, 1).link_position.size(), 0);
}

TEST(ClosedLoop, RefusesALogRateThatDoesNotDivide) {
  const Robot robot = Puma();
  ClosedLoopOptions options;
  options.sensors.log_rate_hz = 300;
  EXPECT_THAT([&] { RunPuma(Plain(robot), robot, options, 1); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "expected Hz that divide the controller's")));
}

}  // namespace armcal::closed_loop_test
