#include "calib/excite/motion_advice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration_report.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::motion_advice_test {

using Eigen::VectorXd;
using testing::HasSubstr;

// The PUMA 560 of shared/reference/e_identifiability.py, rigid.
class MotionAdviceTest : public testing::Test {
 protected:
  MotionAdviceTest() : robot_(SampleRobot("PUMA560 6R")) {
    SetRandomInertials(&random_, &robot_);
    options_.joint_terms = {};
    reader_.joint_names = robot_.JointNames();
  }

  // A file with a motion of some joints (from 0) about that posture, with 0.1 %
  // of noise.
  std::string LogOf(const std::vector<int>& joints, const std::string& name) {
    Multisine motion = RandomMultisine(&random_, 6);
    motion.offset << .2, -.5, .4, .3, .6, -.2;
    for (int j = 0; j < 6; ++j) {
      if (std::count(joints.begin(), joints.end(), j) == 0) {
        motion.amplitude.row(j).setZero();
      }
    }
    Log log = RecordMotion(motion, 12, .01);
    AddTorque(robot_, &log);
    AddNoise(&random_, .001 * ColumnRms(log.tau), &log.tau);
    return WriteFile(LogCsv(log), name);
  }
  LinearCalibration Calibrate(const LogSet& logs) {
    return CalibrateLinear(robot_, options_, logs, nullptr);
  }

  std::mt19937_64 random_{3};
  Robot robot_;
  LinearCalibrationOptions options_;
  LogReaderOptions reader_;
};

// Whoever does as advised, with motions of their own, sees all 36.
TEST_F(MotionAdviceTest, WhatItAdvisesShowsEverything) {
  std::vector<std::string> paths = {LogOf({1, 2}, "two.csv")};
  LogSet two(LogFiles(paths), reader_, {});
  const LinearCalibration poor = Calibrate(two);
  ASSERT_TRUE(poor.solved) << poor.reason;
  EXPECT_EQ(poor.identifiability.total, 36);
  EXPECT_LT(poor.identifiability.batch_rank, 25);
  const auto advice = AdviseMotions(robot_, poor, options_, two);
  ASSERT_FALSE(advice.empty());
  EXPECT_EQ(advice.back().rank, 36);
  for (const AdvisedMotion& motion : advice) {
    paths.push_back(
        LogOf(motion.joints, "more" + std::to_string(paths.size()) + ".csv"));
  }
  LogSet more(LogFiles(paths), reader_, {});
  EXPECT_EQ(Calibrate(more).identifiability.batch_rank, 36)
      << AdviceText(robot_, advice, 36);
}

TEST_F(MotionAdviceTest, NothingIsAdvisedWhereNothingIsMissing) {
  LogSet all({LogOf({0, 1, 2, 3, 4, 5}, "all.csv")}, reader_, {});
  const LinearCalibration rich = Calibrate(all);
  EXPECT_EQ(rich.identifiability.batch_rank, 36);
  EXPECT_TRUE(AdviseMotions(robot_, rich, options_, all).empty());
}

TEST_F(MotionAdviceTest, ReadsLikeASentence) {
  EXPECT_EQ(AdviceText(robot_, {{{3, 4}, 30}, {{0}, 36}}, 36),
            "move " + robot_.links[3].joint.name + " and " +
                robot_.links[4].joint.name + " together (30 of 36), then " +
                robot_.links[0].joint.name + " (36 of 36)");
  EXPECT_THAT(AdviceText(robot_, {{{0, 1, 2, 3, 4, 5}, 36}}, 36),
              HasSubstr("move all joints together"));
}

}  // namespace armcal::motion_advice_test
