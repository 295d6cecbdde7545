#include "calib/closed_loop/replay.h"

#include <gmock/gmock.h>

#include "tests/fixtures/corrected_arm.h"

namespace armcal::replay_test {

using Eigen::VectorXd;

// A log of this plant under the arm's controller, 6 s at 250 Hz.
CommandedLog Record(const CorrectedArm& arm, const SimulatedRobot& plant,
                    double torque_delay = 0) {
  SimbodyArm engine(plant.robot);
  ClosedLoopOptions options;
  options.controller = arm.Controller();
  options.sensors.torque_delay = torque_delay;
  return {"log",
          RunClosedLoop(plant, arm.file, arm.Motion(6), options, &engine).log};
}

struct Misfit {
  double position, torque;  // rms, rad and N m
};
Misfit Replay(const CorrectedArm& arm, const SimulatedRobot& plant,
              double delay, const CommandedLog& log) {
  const ClosedLoopReplay replay =
      ReplayClosedLoop(plant, delay, arm.file, arm.Controller(), log);
  EXPECT_TRUE(replay.finite);
  EXPECT_EQ(replay.position.rows(), log.log.size() - FirstCounted(log.log));
  const double root = std::sqrt(replay.position.size());
  return {replay.position.norm() / root, replay.torque.norm() / root};
}

// The command is stamped by the clock that stamps the motion.
TEST(ReplayClosedLoop, FollowsACommandThatAWrongClockStamped) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(true);
  plant.clock = [](double t) { return 1.05 * t; };
  const CommandedLog log = Record(arm, plant);
  EXPECT_NEAR(log.log.t[log.log.size() - 1], 6.3, 1e-9);
  const Misfit told = Replay(arm, plant, 0, log);
  EXPECT_LT(told.position, 1e-6);
  const Misfit untold = Replay(arm, arm.Truth(true), 0, log);
  EXPECT_GT(untold.torque, 20 * told.torque);
  EXPECT_GT(untold.position, 20 * told.position);
}

// A positive delay is in the recorded torque alone.
TEST(ReplayClosedLoop, RecordsTorqueLate) {
  const CorrectedArm arm;
  const SimulatedRobot plant = arm.Truth(true);
  const CommandedLog log = Record(arm, plant, 8e-3);
  const Misfit told = Replay(arm, plant, 8e-3, log);
  const Misfit untold = Replay(arm, plant, 0, log);
  EXPECT_LT(told.torque, .05 * untold.torque);
  EXPECT_EQ(told.position, untold.position);
}

// A negative one is a lag of the drives, which the motion feels.
TEST(ReplayClosedLoop, DrivesLag) {
  const CorrectedArm arm;
  SimulatedRobot plant = arm.Truth(true);
  ActuatorMap lag;
  lag.initial_state = VectorXd::Zero(3);
  lag.apply = [](const ArmInstant&, const double* state, double* rate,
                 VectorXd* torque) {
    for (int j = 0; j < 3; ++j) {
      rate[j] = ((*torque)[j] - state[j]) / 4e-3;
      (*torque)[j] = state[j];
    }
  };
  plant.actuators.push_back(lag);
  const CommandedLog log = Record(arm, plant);
  const Misfit told = Replay(arm, arm.Truth(true), -4e-3, log);
  EXPECT_LT(told.position, 1e-6);
  EXPECT_GT(Replay(arm, arm.Truth(true), 0, log).position, 20 * told.position);
}

}  // namespace armcal::replay_test
