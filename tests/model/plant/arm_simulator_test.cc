#include "model/plant/arm_simulator.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::arm_simulator_test {

using Eigen::VectorXd;

// One link that turns about the vertical: no gravity torque, inertia J.
SimulatedRobot Flywheel(double inertia, double armature = 0) {
  SimulatedRobot robot;
  Link link;
  link.name = "wheel";
  link.joint.name = "axle";
  link.joint.armature = armature;
  link.inertial = InertialParameters::FromCenterOfMass(
      1, Eigen::Vector3d::Zero(),
      Eigen::Vector3d(inertia, inertia, inertia).asDiagonal());
  robot.robot.links = {link};
  return robot;
}

VectorXd One(double value) { return VectorXd::Constant(1, value); }

// Simulates `duration` and gives the instant it ends at.
ArmInstant Simulate(const SimulatedRobot& robot, const VectorXd& q0,
                    const VectorXd& torque, double duration,
                    double step = 1e-3) {
  SimbodyArm arm(robot.robot);
  ArmSimulator simulator(robot, q0, {step, 0}, &arm);
  const long steps = std::lround(duration / step);
  for (long k = 0; k < steps; ++k) simulator.Step(torque);
  return simulator.instant();
}

TEST(ArmSimulator, ConstantTorqueTurnsLinkAndArmature) {
  const ArmInstant end = Simulate(Flywheel(.3, .2), One(.1), One(2), 1);
  EXPECT_NEAR(end.position[0], .1 + .5 * 2 / .5, 1e-9);
  EXPECT_NEAR(end.velocity[0], 2 / .5, 1e-9);
}

// An arm that swings freely goes where Simbody's own integrator takes it.
TEST(ArmSimulator, SwingsAsSimbodyIntegratesItself) {
  std::mt19937_64 random(5);
  Robot robot = SampleRobot("PUMA560 6R");
  SetRandomInertials(&random, &robot);
  const VectorXd q0 = UniformVector(&random, 6, -1, 1);
  VectorXd q = q0, qd = VectorXd::Zero(6);
  SimbodyArm arm(robot);
  ASSERT_TRUE(arm.Swing(.5, 1e-10, 10000, &q, &qd));
  SimulatedRobot plant;
  plant.robot = robot;
  const VectorXd none = VectorXd::Zero(6);
  const VectorXd coarse = Simulate(plant, q0, none, .5, 1e-3).position - q;
  const VectorXd fine = Simulate(plant, q0, none, .5, 5e-4).position - q;
  EXPECT_LT(fine.norm(), 1e-4);
  // Third order in the step.
  EXPECT_NEAR(coarse.norm() / fine.norm(), 8, 1);
  // And on from the midst of its swing.
  ArmSimulator simulator(plant, q, {1e-3, 0, 0}, &arm);
  simulator.SetMotors(q, qd);
  for (int k = 0; k < 200; ++k) simulator.Step(none);
  ASSERT_TRUE(arm.Swing(.2, 1e-10, 10000, &q, &qd));
  EXPECT_LT((simulator.instant().position - q).norm(), 1e-4);
}

// Coulomb friction F on inertia J stops a wheel of speed w after w J / F,
// having turned w^2 J / (2 F).
TEST(ArmSimulator, FrictionStopsAWheel) {
  SimulatedRobot robot = Flywheel(.5);
  robot.joint_laws.push_back(
      {0, VectorXd(), true, [](const ArmInstant& at, const double*, double*) {
         // Brakes from 1 s on; accelerates before.
         return at.t < 1 ? 1.0 : -2 * std::tanh(at.velocity[0] / .002);
       }});
  const double speed = 1 / .5, angle = .5 * 1 / .5;
  const ArmInstant end = Simulate(robot, One(0), One(0), 2);
  // The last stage before the switch already brakes: 1/6 of a substep.
  const double early = 1e-3 / 4 / 6 * (1 + 2) / .5;
  EXPECT_NEAR(end.position[0], angle + speed * speed * .5 / (2 * 2), early);
  EXPECT_NEAR(end.velocity[0], 0, 1e-6);
  // The energy of the wheel went into heat, less what leaked in a second.
  EXPECT_NEAR(end.temperature[0], (.5 * .5 * speed * speed - 2 * .5) / 2000,
              2e-5);
}

// Two inertias J1, J2 and a spring k ring at sqrt(k (1 / J1 + 1 / J2)).
TEST(ArmSimulator, TwoMassesRingAtTheirFrequency) {
  SimulatedRobot robot = Flywheel(.3, .1);
  const double k = 400;
  Transmission spring;
  spring.torque = [k](double x, double, const double*, double*) {
    return k * x;
  };
  robot.transmissions.push_back(spring);
  // A step of torque T: the deflection is T J2 / (J1 + J2) / k (1 - cos wt).
  const double w = std::sqrt(k * (1 / .3 + 1 / .1));
  const double half_turn = M_PI / w;
  const ArmInstant end =
      Simulate(robot, One(0), One(3), half_turn, half_turn / 40);
  EXPECT_NEAR(end.position[0] - end.link_position[0], 2 * 3 * .75 / k, 1e-7);
  EXPECT_NEAR(end.load[0], k * 2 * 3 * .75 / k, 1e-3);
}

// A motor that starts in the middle of a gap and then hits its flanks of
// stiffness k, without loss: all work on it is in the two masses and the
// spring.
TEST(ArmSimulator, ContactsAreStiffAlthoughTheStartIsNot) {
  SimulatedRobot robot = Flywheel(2e-5, 2e-5);
  const double k = 40000, gap = 1e-3, T = .01;
  Transmission flanks;
  flanks.torque = [=](double x, double, const double*, double*) {
    return k * (x - std::clamp(x, -gap / 2, gap / 2));
  };
  flanks.stiffest = k;
  robot.transmissions.push_back(flanks);
  const ArmInstant end = Simulate(robot, One(0), One(T), .05);
  const double pressed =
      std::max(0., std::abs(end.position[0] - end.link_position[0]) - gap / 2);
  const double energy = 1e-5 * (std::pow(end.velocity[0], 2) +
                                std::pow(end.link_velocity[0], 2)) +
                        k / 2 * pressed * pressed;
  EXPECT_NEAR(energy / (T * end.position[0]), 1, .02);
  // And where the torque takes them: T t / (J + I).
  EXPECT_NEAR((end.velocity[0] + end.link_velocity[0]) / 2, T * .05 / 4e-5,
              1e-6);
}

// A pendulum pulled sideways by a force at its tip rests at tan(q) = F / (m g).
TEST(ArmSimulator, WrenchActsThroughTheJacobian) {
  SimulatedRobot robot = Flywheel(0);
  Link& link = robot.robot.links[0];
  link.X_PF.linear() =
      Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()).matrix();
  link.inertial = InertialParameters::FromCenterOfMass(
      2, Eigen::Vector3d(0, .5, 0), Eigen::Matrix3d::Zero());
  robot.joint_laws.push_back(
      {0, VectorXd(), false, [](const ArmInstant& at, const double*, double*) {
         return -6 * at.velocity[0];
       }});
  WrenchLaw pull;
  pull.attachment = {0, Eigen::Vector3d(0, .5, 0)};
  pull.wrench = [](const PointInstant&, const double*, double*) {
    return Wrench{Eigen::Vector3d::Zero(), Eigen::Vector3d(7, 0, 0)};
  };
  robot.wrenches.push_back(pull);
  const ArmInstant end = Simulate(robot, One(0), One(0), 12);
  EXPECT_NEAR(std::abs(end.position[0]), std::atan(7 / (2 * 9.81)), 1e-6);
}

// A first-order lag of the actuator: speed = T / J (t - tau (1 - e^-t/tau)).
TEST(ArmSimulator, ActuatorMapsHaveStates) {
  SimulatedRobot robot = Flywheel(.5);
  ActuatorMap lag;
  lag.initial_state = One(0);
  lag.apply = [](const ArmInstant&, const double* state, double* rate,
                 VectorXd* torque) {
    rate[0] = ((*torque)[0] - state[0]) / .05;
    (*torque)[0] = state[0];
  };
  robot.actuators.push_back(lag);
  const ArmInstant end = Simulate(robot, One(0), One(1), .2);
  EXPECT_NEAR(end.velocity[0], (.2 - .05 * (1 - std::exp(-4))) / .5, 1e-8);
}

// Started in motion: two masses on a spring go on together, the motor as far
// ahead as it hangs at rest.
TEST(ArmSimulator, StartsInMotion) {
  SimulatedRobot robot = Flywheel(.3, .1);
  Transmission spring;
  spring.torque = [](double x, double, const double*, double*) {
    return 400 * x;
  };
  spring.initial_deflection = [](double) { return 0.; };
  robot.transmissions.push_back(spring);
  SimbodyArm arm(robot.robot);
  ArmSimulator simulator(robot, One(0), {1e-3, 0, 2}, &arm);
  simulator.SetMotors(One(.2), One(3));
  EXPECT_EQ(simulator.instant().t, 2);
  for (int k = 0; k < 500; ++k) simulator.Step(One(0));
  EXPECT_NEAR(simulator.instant().position[0], .2 + 3 * .5, 1e-9);
  EXPECT_NEAR(simulator.instant().link_position[0], .2 + 3 * .5, 1e-9);
  // Under way the link stays where it is, and a copy goes its own way.
  ArmSimulator copy = simulator;
  copy.SetMotors(One(1.71), One(3));
  EXPECT_EQ(copy.instant().link_position[0],
            simulator.instant().link_position[0]);
  copy.Step(One(0));
  EXPECT_NEAR(copy.instant().load[0], 400 * .01, .1);
  EXPECT_NEAR(simulator.instant().load[0], 0, 1e-6);
}

TEST(ArmSimulator, RefusesWhatItCannotIntegrate) {
  SimulatedRobot robot = Flywheel(.5);
  robot.joint_laws.push_back(
      {0, VectorXd(), true, [](const ArmInstant& at, const double*, double*) {
         return -1e10 * at.position[0];
       }});
  EXPECT_THAT([&] { Simulate(robot, One(0), One(0), .1); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr(
                  "joint axle: its laws are too stiff to simulate")));
  robot = Flywheel(.5);
  robot.transmissions.push_back(Transmission());
  EXPECT_THAT([&] { Simulate(robot, One(0), One(0), .1); },
              testing::ThrowsMessage<InputError>(
                  testing::HasSubstr("joint axle: a transmission")));
}

}  // namespace armcal::arm_simulator_test
