#include "calib/linear/transition_search.h"

#include <gtest/gtest.h>

#include "calib/linear/calibration_model.h"
#include "tests/fixtures/drive_gain_runs.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::transition_search_test {

Transitions Find(const Robot& robot, const Log& log) {
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  LogSet set({WriteFile(LogCsv(log))}, reader, TimeRange());
  const LinearCalibrationOptions options;
  const RowOptions rows = MakeRowOptions(options, set);
  return FindTransitions(robot, options, rows,
                         Prepare(set, PreparationForRows(rows)),
                         TorqueUnits::kPerJoint);
}

// Joint by joint, what unit each joint's torque is in does not matter: currents
// of drives with any gains give the transitions of torques, which are those of
// the simulation.
TEST(TransitionSearch, PerJointKnowsNoScale) {
  std::mt19937_64 random(4);
  const DrivenArm driven = MakeDrivenArm("3R elbow", &random);
  Log torque = MoveArm(driven.arm.truth, 15, &random);
  AddDriveNoise(.01, 1e-5, &random, &torque);
  const Transitions of_torques = Find(driven.arm.file, torque);
  const Transitions of_currents =
      Find(driven.arm.file, ToCurrents(torque, driven.K));
  ASSERT_EQ(of_torques.size(), 3u);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(of_torques[j][0].law, of_currents[j][0].law) << j;
    EXPECT_NEAR(of_currents[j][0].width / of_torques[j][0].width, 1, 1e-6) << j;
    EXPECT_EQ(of_currents[j][0].law, kTransition.law) << j;
    EXPECT_NEAR(of_currents[j][0].width / kTransition.width, 1, .5) << j;
  }
}

}  // namespace armcal::transition_search_test
