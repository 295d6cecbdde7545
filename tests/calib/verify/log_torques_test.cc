#include "calib/verify/log_torques.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::log_torques_test {

// Two logs of 3 s and 1 s of a 3R arm with viscous friction and armature,
// whose torque is the robot's to rounding.
class LogTorquesOfAnArm : public testing::Test {
 protected:
  LogTorquesOfAnArm() : truth_(SampleRobot("3R elbow")) {
    SetRandomInertials(&random_, &truth_);
    for (Link& link : truth_.links) {
      link.joint.viscous = 1.5;
      link.joint.armature = .2;
    }
    Log first = RecordMotion(RandomMultisine(&random_, 3), 3, .002);
    AddTorque(truth_, &first);
    Log second = RecordMotion(RandomMultisine(&random_, 3), 1, .002);
    AddTorque(truth_, &second);
    LogReaderOptions reader;
    reader.joint_names = truth_.JointNames();
    logs_.emplace(LogFiles({WriteFile(LogCsv(first, true), "first.csv"),
                            WriteFile(LogCsv(second, true), "second.csv")}),
                  reader, TimeRange());
  }

  LogTorques Compare(const Robot& file, const CalibratedRobot* calibrated) {
    return CompareLogTorques(file, calibrated, {}, Prepare(*logs_, {}));
  }

  std::mt19937_64 random_{5};
  Robot truth_;
  std::optional<LogSet> logs_;
};

// An offset of one joint is missing from that joint's torque, and nothing is
// from the truth's.
TEST_F(LogTorquesOfAnArm, WhatTheFileLacksIsLeftOver) {
  Robot file = truth_;
  file.links[1].joint.offset += .3;
  CalibratedRobot calibrated;
  calibrated.robot = truth_;
  calibrated.transitions.resize(3);
  const LogTorques torques = Compare(file, &calibrated);
  EXPECT_NEAR(torques.samples, 2000, 5);
  EXPECT_LT(torques.max_rel, 1e-10);
  ASSERT_EQ(torques.joints.size(), 3u);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(torques.joints[j].unit, "N m");
    EXPECT_GT(torques.joints[j].recorded_rms, .4);
    EXPECT_NEAR(torques.joints[j].before_rms, j == 1 ? .3 : 0, 1e-6);
    EXPECT_NEAR(torques.joints[j].after_rms, 0, 1e-6);
  }
}

// Coulomb friction of either law is the same by both ways, through the states
// that the log's motion leaves it in.
TEST_F(LogTorquesOfAnArm, CoulombFrictionGoesWithTheLog) {
  using Law = CoulombTransition::Law;
  CalibratedRobot calibrated;
  calibrated.robot = truth_;
  calibrated.transitions = {
      {Law::kDisplacement, .05}, {Law::kVelocity, .1}, {Law::kVelocity, .02}};
  for (Link& link : calibrated.robot.links) link.joint.coulomb = 3;
  const LogTorques torques = Compare(truth_, &calibrated);
  EXPECT_LT(torques.max_rel, 1e-10);
  for (const JointLogTorque& joint : torques.joints) {
    EXPECT_GT(joint.after_rms, 1.5);
    EXPECT_LE(joint.after_rms, 3 + 1e-6);
  }
}

TEST_F(LogTorquesOfAnArm, ARobotThatSimbodyRefusesHasNoFigures) {
  Robot impossible = truth_;
  impossible.links[2].inertial.inertia = Eigen::Vector3d(1, 1, 9).asDiagonal();
  const LogTorques torques = Compare(impossible, nullptr);
  EXPECT_TRUE(std::isnan(torques.max_rel));
  EXPECT_TRUE(std::isnan(torques.joints[0].before_rms));
  EXPECT_TRUE(std::isnan(torques.joints[0].after_rms));
  EXPECT_GT(torques.joints[0].recorded_rms, 0);
}

}  // namespace armcal::log_torques_test
