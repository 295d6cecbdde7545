#include "model/plant/steady_loop.h"

#include <gmock/gmock.h>

#include <random>

#include "model/dynamics/rigid_arm.h"
#include "model/plant/closed_loop.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::steady_loop_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Robot PumaWith(double armature) {
  std::mt19937_64 random(2);
  Robot robot = SampleRobot("PUMA560 6R");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) link.joint.armature = armature;
  return robot;
}

ReferenceMotion Fourier(const Robot& robot) {
  return FourierMotion(robot, MotionOptions());
}

// A small step beside a posture.
ReferenceMotion StepAt(const VectorXd& q) {
  ReferenceMotion motion;
  motion.duration = 4;
  motion.at = [q](double t) {
    ReferencePoint point{q, VectorXd::Zero(q.size()), VectorXd::Zero(q.size())};
    if (t > 0) point.q.array() += 1e-5;
    return point;
  };
  return motion;
}

ControllerOptions Times(ControllerOptions controller, double factor) {
  for (DriveLaw& law : controller.drives) {
    law.kp *= factor;
    law.kd *= factor;
    law.ki *= factor;
  }
  return controller;
}

double LargestDeviation(const Log& log, double begin, double end) {
  double largest = 0;
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] < begin || log.t[k] > end) continue;
    largest = std::max(largest,
                       (log.q.row(k) - log.qref.row(k)).cwiseAbs().maxCoeff());
  }
  return largest;
}

// How many times as large the arm's deviations are after 1.5 s.
double Growth(const Robot& robot, const ReferenceMotion& motion,
              const ControllerOptions& controller) {
  ClosedLoopOptions options;
  options.controller = controller;
  SimulatedRobot plant;
  plant.robot = robot;
  RigidArm arm(robot);
  const Log log = RunClosedLoop(plant, robot, motion, options, &arm).log;
  return LargestDeviation(log, 2, 2.5) / LargestDeviation(log, .5, 1);
}

// The arm itself says so, simulated in small deviations from rest.
TEST(SteadyLoop, StabilityIsThatOfTheArm) {
  const Robot robot = PumaWith(0);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> angle(-1, 1);
  for (int draw = 0; draw < 4; ++draw) {
    VectorXd q(6);
    for (double& x : q) x = angle(random);
    const ReferenceMotion motion = StepAt(q);
    const ControllerOptions controller = DefaultController(robot, q, 4);
    double low = .01, high = 100;
    for (int k = 0; k < 20; ++k) {
      const double middle = std::sqrt(low * high);
      (IsStable(robot, controller, motion, middle) ? low : high) = middle;
    }
    ASSERT_GT(low, .02) << draw;
    ASSERT_LT(high, 50) << draw;
    EXPECT_LT(Growth(robot, motion, Times(controller, .95 * low)), 1) << draw;
    EXPECT_GT(Growth(robot, motion, Times(controller, 1.05 * low)), 1) << draw;
  }
}

// Of arms without motors' inertia, many of which lack it with the usual
// gains.
TEST(SteadyLoop, GainsHaveAMarginAlongTheMotion) {
  int lack = 0;
  for (const char* name : {"PUMA560 6R", "Panda 7R"}) {
    for (int draw = 0; draw < 10; ++draw) {
      std::mt19937_64 random(draw);
      Robot robot = SampleRobot(name);
      SetRandomInertials(&random, &robot);
      const ReferenceMotion motion = Fourier(robot);
      const ControllerOptions usual =
          DefaultController(robot, motion.at(0).q, 8);
      const ControllerOptions steady = SteadyController(robot, motion, 8);
      lack += !IsStable(robot, usual, motion, 2);
      EXPECT_TRUE(IsStable(robot, steady, motion, 2)) << name << draw;
      EXPECT_TRUE(IsStable(robot, steady, motion, .5)) << name << draw;
    }
  }
  EXPECT_GT(lack, 5);
}

// Nothing is taken from gains that have it as they are.
TEST(SteadyLoop, IsTheUsualOneOfAnArmWithMotors) {
  const Robot robot = PumaWith(3);
  const ReferenceMotion motion = Fourier(robot);
  const ControllerOptions usual = DefaultController(robot, motion.at(0).q, 8);
  const ControllerOptions steady = SteadyController(robot, motion, 8);
  for (int j = 0; j < 6; ++j) {
    EXPECT_EQ(steady.drives[j].kp, usual.drives[j].kp);
    EXPECT_EQ(steady.drives[j].kd, usual.drives[j].kd);
    EXPECT_LE(steady.drives[j].ki, usual.drives[j].ki);
    EXPECT_GT(steady.drives[j].ki, .5 * usual.drives[j].ki);
  }
}

}  // namespace armcal::steady_loop_test
