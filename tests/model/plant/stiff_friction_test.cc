// Friction that stops a light wrist within microseconds.

#include <gtest/gtest.h>

#include <cmath>

#include "model/plant/arm_simulator.h"
#include "model/plant/simbody_arm.h"

namespace armcal::stiff_friction_test {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Links that turn about one vertical axis, one on the other.
SimulatedRobot Wheels(const std::vector<double>& inertias) {
  SimulatedRobot robot;
  for (const double inertia : inertias) {
    Link link;
    link.name = "wheel" + std::to_string(robot.robot.links.size());
    link.joint.name = "axle" + std::to_string(robot.robot.links.size());
    link.inertial = InertialParameters::FromCenterOfMass(
        1, Vector3d::Zero(), Vector3d::Constant(inertia).asDiagonal());
    robot.robot.links.push_back(link);
  }
  return robot;
}

VectorXd EndsAt(const SimulatedRobot& robot, const VectorXd& torque,
                double duration, int substeps = 0) {
  SimbodyArm arm(robot.robot);
  const VectorXd q0 = VectorXd::Zero(robot.robot.num_joints());
  ArmSimulator simulator(robot, q0, {1e-3, substeps}, &arm);
  const long steps = std::lround(duration / 1e-3);
  for (long k = 0; k < steps; ++k) {
    // Back and forth, 5 times a second.
    simulator.Step(std::cos(2 * M_PI * 5 * k * 1e-3) * torque);
  }
  return simulator.instant().position;
}

// J v' + b v = tau cos(w t): with J / b = 5 us, v = tau / b cos(w t) in all but
// 2e-4 of it, and a torque that is held over steps of 1 ms turns the wheel by
// tau / b 1 ms each.
TEST(StiffFriction, ViscousIsAsFastAsItsTorque) {
  SimulatedRobot robot = Wheels({1e-5});
  robot.joint_laws.push_back(
      {0, VectorXd(), true, [](const ArmInstant& at, const double*, double*) {
         return -2 * at.velocity[0];
       }});
  const VectorXd torque = VectorXd::Constant(1, 3);
  double expected = 0;
  for (int k = 0; k < 130; ++k) {
    expected += 1e-3 * 3. / 2 * std::cos(2 * M_PI * 5 * k * 1e-3);
  }
  EXPECT_NEAR(EndsAt(robot, torque, .13)[0], expected, 2e-4 * 3. / 2 * .13);
}

// A wrist of 1e-5 kg m^2 with .05 N m of dry friction on an arm that swings: by
// explicit steps that are short enough, 2048 a millisecond, it goes the same
// way.
TEST(StiffFriction, DryIsThatOfShortExplicitSteps) {
  SimulatedRobot robot = Wheels({.1, 1e-5});
  robot.joint_laws.push_back(
      {1, VectorXd(), true, [](const ArmInstant& at, const double*, double*) {
         return -.05 * std::tanh(at.velocity[1] / .005) - .01 * at.velocity[1];
       }});
  const Vector2d torque(2, .08);
  const VectorXd explicitly = EndsAt(robot, torque, .23, 2048);
  const VectorXd implicitly = EndsAt(robot, torque, .23);
  EXPECT_GT(std::abs(explicitly[1]), .01);
  EXPECT_NEAR(implicitly[0], explicitly[0], 1e-5);
  EXPECT_NEAR(implicitly[1], explicitly[1], 5e-3 * std::abs(explicitly[1]));
}

}  // namespace armcal::stiff_friction_test
