#include "calib/diagnose/judge/window_replay.h"

#include <gmock/gmock.h>

#include <cmath>

#include "model/signals/low_pass.h"
#include "tests/fixtures/corrected_arm.h"

namespace armcal::window_replay_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What the arm's log without noise shows of a plant, at the controller's rate.
GapSegment Record(const CorrectedArm& arm, const SimulatedRobot& plant) {
  SimbodyArm engine(plant.robot);
  ClosedLoopOptions options;
  options.controller = arm.Controller();
  options.sensors.log_rate_hz = 1000;
  const Log log =
      RunClosedLoop(plant, arm.file, arm.Motion(6), options, &engine).log;
  GapSegment segment;
  const double dt = log.t[1] - log.t[0];  // as the clock has it
  segment.motion.dt = dt;
  segment.motion.q = log.q;
  segment.motion.qd = Differentiate(log.q, dt);
  segment.motion.qdd = Differentiate(segment.motion.qd, dt);
  segment.tau = log.tau;
  segment.still.setConstant(segment.size(), 3, false);
  return segment;
}

// rms of the robot's deviations on its own log, rad.
VectorXd Deviation(const CorrectedRobot& robot, const GapSegment& segment) {
  const ReplayWindows windows = CutWindows(segment, .5);
  EXPECT_EQ(windows.begin.size(), 10u);  // from 1 s on
  return ReplaySquares(robot, segment, windows)
      .colwise()
      .mean()
      .cwiseSqrt()
      .transpose();
}

// With any effect, so that windows are led to.
CorrectedRobot Led(const SimulatedRobot& plant) {
  CorrectedRobot robot;
  robot.plant = plant;
  robot.effects.resize(1);
  return robot;
}
CorrectedRobot NotLed(const SimulatedRobot& plant) {
  CorrectedRobot robot;
  robot.plant = plant;
  return robot;
}

// Its last law keeps the state it starts with.
SimulatedRobot WithoutState(SimulatedRobot plant) {
  JointLaw& law = plant.joint_laws.back();
  law.torque = [start = law.initial_state, torque = law.torque](
                   const ArmInstant& at, const double*, double*) {
    VectorXd unused = start;
    return torque(at, start.data(), unused.data());
  };
  law.initial_state.resize(0);
  return plant;
}

TEST(ReplaySquares, ARobotFollowsItsOwnLog) {
  const CorrectedArm arm;
  const SimulatedRobot plant = arm.Truth(true);
  const GapSegment segment = Record(arm, plant);
  const VectorXd truth = Deviation(NotLed(plant), segment);
  EXPECT_LT(truth.maxCoeff(), 2e-4);
  EXPECT_LT(Deviation(Led(plant), segment).maxCoeff(), 2e-4);
  EXPECT_GT(Deviation(NotLed(arm.Truth(false)), segment)[1], 20 * truth[1]);
}

// Drag that builds up within a second of motion: a law with a state.
TEST(ReplaySquares, LawsRememberTheMotionBeforeAWindow) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(false);
  plant.joint_laws.push_back(
      {0, VectorXd::Zero(1), false,
       [](const ArmInstant& at, const double* state, double* rate) {
         *rate = std::abs(at.velocity[0]) - state[0];
         return -20 * state[0] * std::tanh(at.velocity[0] / .01);
       }});
  const GapSegment segment = Record(arm, plant);
  EXPECT_LT(Deviation(Led(plant), segment)[0], 2e-4);
  // The same from the state at rest at each window's begin.
  EXPECT_GT(Deviation(NotLed(WithoutState(plant)), segment)[0], 1e-2);
}

// The encoder is on the motor, and the link hangs behind it by what it carries.
TEST(ReplaySquares, LinksHangBehindTheirMotors) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(false);
  Transmission spring;
  spring.joint = 1;
  spring.torque = [](double d, double rate, const double*, double*) {
    return 3000 * d + 20 * rate;
  };
  spring.initial_deflection = [](double load) { return load / 3000; };
  plant.transmissions.push_back(spring);
  const GapSegment segment = Record(arm, plant);
  const double led = Deviation(Led(plant), segment)[1];
  EXPECT_LT(led, 5e-4);
  EXPECT_GT(Deviation(NotLed(plant), segment)[1], 4 * led);
}

// A zero of the encoder that is off by 0.1 rad and a torque that reads 10 % too
// much: the motion and the torque behind the readings are what the robot had.
TEST(ReplaySquares, SeesTheMotionBehindTheReadings) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(false);
  plant.sensors.push_back({[](const ArmInstant&, Reading* reading) {
    reading->position[1] += .1;
    reading->torque[2] *= 1.1;
  }});
  const GapSegment segment = Record(arm, plant);
  EXPECT_LT(Deviation(Led(plant), segment).maxCoeff(), 2e-4);
  const double without_offset =
      Deviation(NotLed(arm.Truth(false)), segment).maxCoeff();
  EXPECT_GT(without_offset, 1e-2);
}

TEST(ReplaySquares, KnowsTheClock) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(false);
  plant.clock = [](double t) { return 1.01 * t; };
  const GapSegment segment = Record(arm, plant);
  EXPECT_NEAR(segment.motion.dt, 1.01e-3, 1e-12);
  const double told = Deviation(Led(plant), segment).maxCoeff();
  EXPECT_LT(told, 2e-4);
  EXPECT_GT(Deviation(NotLed(arm.Truth(false)), segment).maxCoeff(), 5 * told);
}

// Torque that is recorded late.
TEST(ReplaySquares, TakesTorqueFromWhereItIs) {
  const CorrectedArm arm;
  CorrectedRobot robot = NotLed(arm.Truth(false));
  GapSegment segment = Record(arm, robot.plant);
  const int late = 5;  // samples of 1 ms
  const MatrixXd tau = segment.tau;
  segment.tau.bottomRows(tau.rows() - late) = tau.topRows(tau.rows() - late);
  robot.delay = late * 1e-3;
  const double told = Deviation(robot, segment).maxCoeff();
  EXPECT_LT(told, 2e-4);
  robot.delay = 0;
  EXPECT_GT(Deviation(robot, segment).maxCoeff(), 10 * told);
}

TEST(CutWindows, LeavesOutStandstill) {
  GapSegment segment;
  segment.motion.dt = .01;
  segment.motion.q = MatrixXd::Zero(401, 2);
  segment.still.setConstant(401, 2, false);
  segment.still.block(200, 0, 100, 2).setConstant(true);
  segment.still.block(300, 0, 100, 1).setConstant(true);
  const ReplayWindows windows = CutWindows(segment, .5);
  EXPECT_EQ(windows.length, 50);
  EXPECT_THAT(windows.begin, testing::ElementsAre(100, 150, 300, 350));
}

}  // namespace armcal::window_replay_test
