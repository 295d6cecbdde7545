#include "calib/excite/segment_selection.h"

#include <gtest/gtest.h>

#include "calib/linear/calibrate_linear.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::segment_selection_test {

// 30 s of which joint 1 alone moves but for five seconds from 20 s on, where
// all do, and a second log in which joint 2 moves.
class SegmentSelectionTest : public testing::Test {
 protected:
  SegmentSelectionTest() : robot_(SampleRobot("3R elbow")) {
    SetRandomInertials(&random_, &robot_);
    options_.joint_terms = {};
    LogReaderOptions reader;
    reader.joint_names = robot_.JointNames();
    logs_.emplace(LogFiles({Write({0}, true, "long.csv"),
                            Write({1}, false, "other.csv")}),
                  reader, TimeRange());
    linear_.emplace(CalibrateLinear(robot_, options_, *logs_, nullptr));
  }

  std::string Write(const std::vector<int>& joints, bool all_late,
                    const std::string& name) {
    Multisine motion = RandomMultisine(&random_, 3);
    Log log = RecordMotion(motion, 30, .01);
    for (int j = 0; j < 3; ++j) {
      if (std::count(joints.begin(), joints.end(), j) > 0) continue;
      for (int s = 0; s < log.size(); ++s) {
        // Fades in and out without a jerk.
        const double u = (log.t[s] - 20) / 5;
        const bool late = all_late && u > 0 && u < 1;
        log.q(s, j) *= late ? std::pow(std::sin(M_PI * u), 4) : 0;
      }
    }
    Differentiate(&log);
    AddTorque(robot_, &log);
    AddNoise(&random_, .005 * ColumnRms(log.tau), &log.tau);
    return WriteFile(LogCsv(log), name);
  }

  static void Differentiate(Log* log) {
    const auto slope = [](const Eigen::MatrixXd& x) {
      Eigen::MatrixXd d = Eigen::MatrixXd::Zero(x.rows(), x.cols());
      const long n = x.rows();
      d.middleRows(1, n - 2) = (x.bottomRows(n - 2) - x.topRows(n - 2)) / .02;
      return d;
    };
    log->qd = slope(log->q);
    log->qdd = slope(log->qd);
  }

  std::mt19937_64 random_{5};
  Robot robot_;
  LinearCalibrationOptions options_;
  std::optional<LogSet> logs_;
  std::optional<LinearCalibration> linear_;
};

TEST_F(SegmentSelectionTest, TheTellingStretchComesFirst) {
  ASSERT_TRUE(linear_->solved) << linear_->reason;
  const SegmentSelection selection =
      SelectSegments(robot_, *linear_, options_, 5, 1.25, *logs_);
  EXPECT_EQ(selection.considered, 12);
  ASSERT_FALSE(selection.chosen.empty());
  EXPECT_EQ(selection.chosen[0].log, 0);
  EXPECT_EQ(selection.chosen[0].range.begin, 20);
  EXPECT_EQ(selection.chosen.back().rank, selection.rank);
  EXPECT_LT(selection.chosen.size(), 10u);
  EXPECT_LE(selection.stddev_ratio, 1.25);
}

// What the selection says of standard deviations is what a calibration on it
// finds, errors of equations being independent.
TEST_F(SegmentSelectionTest, CalibratesNearlyAsWell) {
  const SegmentSelection selection =
      SelectSegments(robot_, *linear_, options_, 5, 1.25, *logs_);
  const LinearCalibration few = CalibrateLinear(
      robot_, options_, logs_->Within(selection.Stretches(*logs_)), nullptr);
  ASSERT_TRUE(few.solved) << few.reason;
  EXPECT_EQ(few.identifiability.batch_rank,
            linear_->identifiability.batch_rank);
  const auto stddev = [](const LinearCalibration& result) {
    return result.independent_covariance.diagonal().cwiseSqrt().array().log();
  };
  const double ratio = std::exp((stddev(few) - stddev(*linear_)).mean());
  EXPECT_GT(ratio, 1);
  EXPECT_NEAR(ratio, selection.stddev_ratio, .15);
}

TEST_F(SegmentSelectionTest, PiecesAreInOrderAndTouchingOnesAreOne) {
  SegmentSelection selection;
  selection.chosen = {
      {1, {5, 10}, 0}, {0, {10, 15}, 0}, {1, {0, 5}, 0}, {0, {20, 25}, 0}};
  const LogSet::Stretches stretches = selection.Stretches(*logs_);
  ASSERT_EQ(stretches.size(), 2u);
  ASSERT_EQ(stretches[0].size(), 2u);
  EXPECT_EQ(stretches[0][0].begin, 10);
  EXPECT_EQ(stretches[0][1].begin, 20);
  ASSERT_EQ(stretches[1].size(), 1u);
  EXPECT_EQ(stretches[1][0].begin, 0);
  EXPECT_EQ(stretches[1][0].end, 10);
}

}  // namespace armcal::segment_selection_test
