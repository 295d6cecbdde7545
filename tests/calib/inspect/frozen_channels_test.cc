#include "calib/inspect/frozen_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/inspect/inspection.h"
#include "model/log_files/log_writer.h"
#include "tests/fixtures/inspected_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::frozen_channels_test {

class FrozenChannelsTest : public testing::Test {
 protected:
  FrozenChannelsTest() : arm_("3R elbow") { arm_.log.qd.resize(0, 0); }

  std::vector<FrozenChannel> Frozen(const Log& log) const {
    return FindFrozenChannels(arm_.robot, log, {log, .01, .05, 8});
  }
  LogInspection Inspect(const Log& log) const {
    LogReaderOptions options;
    options.joint_names = arm_.robot.JointNames();
    return InspectLog(arm_.robot, WriteFile(LogText(log), "frozen.csv"),
                      options);
  }
  // Where joint 2's torque is far from its mean for half a second.
  int LargeTorqueRow() const {
    Eigen::Index row = 0;
    const Eigen::VectorXd tau = arm_.log.tau.col(1);
    tau.segment(200, 1500).cwiseAbs().maxCoeff(&row);
    return static_cast<int>(row) + 175;
  }

  InspectedArm arm_;
};

TEST_F(FrozenChannelsTest, AMotionHasNone) {
  EXPECT_TRUE(Frozen(arm_.log).empty());
}

// Half a second of zeros, and of the value before, in motion.
TEST_F(FrozenChannelsTest, ATorqueThatIsNotRecordedIsTold) {
  const int at = LargeTorqueRow();
  for (const double value : {0., arm_.log.tau(at - 200, 1)}) {
    Log log = arm_.log;
    log.tau.col(1).segment(at, 50).setConstant(value);
    const auto frozen = Frozen(log);
    ASSERT_EQ(frozen.size(), 1u) << value;
    EXPECT_EQ(frozen[0].joint, 1);
    EXPECT_FALSE(frozen[0].is_position);
    EXPECT_EQ(frozen[0].begin, at);
    EXPECT_EQ(frozen[0].end, at + 50);
    EXPECT_GT(frozen[0].gap, 5 * frozen[0].usual);
  }
}

// Of a tenth of the torque's range: it repeats itself all along the log.
TEST_F(FrozenChannelsTest, ARoundedTorqueIsNone) {
  Log log = arm_.log;
  const double quantum = .1 * ColumnRms(log.tau)[1];
  log.tau.col(1) = (log.tau.col(1).array() / quantum).round() * quantum;
  EXPECT_TRUE(Frozen(log).empty());
}

// A drive that gives all it can repeats one value, which is its torque.
TEST_F(FrozenChannelsTest, ATorqueAtItsLimitIsNone) {
  Log log = arm_.log;
  const double limit = ColumnRms(log.tau)[1];
  log.tau = log.tau.cwiseMin(limit).cwiseMax(-limit);
  EXPECT_TRUE(Frozen(log).empty());
}

// That of a link without a load whose drive is off for a while: the arm's model
// says that there is none.
TEST_F(FrozenChannelsTest, ADriveThatIsOffIsNone) {
  Log log = arm_.log;
  const Eigen::Index at = LargeTorqueRow();
  log.tau.col(1).segment(at, 50).setConstant(log.tau(at + 25, 1));
  std::mt19937_64 random(3);
  AddNoise(&random, ColumnRms(log.tau), &log.tau);  // that it is within
  log.tau.col(1).segment(at, 50).setConstant(arm_.log.tau(at + 25, 1));
  EXPECT_TRUE(Frozen(log).empty());
}

// Half the log: no sign, order or zero is asked of what is frozen.
TEST_F(FrozenChannelsTest, AnEncoderThatStopsIsToldAlone) {
  Log log = arm_.log;
  const Eigen::Index half = log.size() / 2;
  log.q.col(1).tail(half).setConstant(log.q(half - 1, 1));
  const auto frozen = Frozen(log);
  ASSERT_EQ(frozen.size(), 1u);
  EXPECT_TRUE(frozen[0].is_position);
  EXPECT_EQ(frozen[0].joint, 1);
  const LogInspection inspection = Inspect(log);
  ASSERT_EQ(inspection.findings.size(), 1u);
  EXPECT_EQ(inspection.findings[0].finding, "stuck");
  EXPECT_FALSE(inspection.as_it_is);
  const Log mended = Mended(arm_.robot, log, inspection);
  EXPECT_EQ(mended.size(), frozen[0].begin);
  EXPECT_EQ(mended.q, log.q.topRows(frozen[0].begin));
  EXPECT_EQ(mended.tau, log.tau.topRows(frozen[0].begin));
}

// A joint that rests while the others move holds what its links weigh.
TEST_F(FrozenChannelsTest, AJointThatRestsIsNone) {
  std::mt19937_64 random(5);
  const Multisine motion = RandomMultisine(&random, 3);
  Log log = RecordMotion(motion, 20, .01);
  const Eigen::Index half = log.size() / 2;
  // It comes to rest within a second, as fast as a cosine.
  for (Eigen::Index k = half - 100; k < log.size(); ++k) {
    const double share =
        std::min(1., static_cast<double>(k - half + 100) / 100);
    const double moves = .5 + .5 * std::cos(M_PI * share);
    log.q(k, 1) = motion.offset[1] + moves * (log.q(k, 1) - motion.offset[1]);
  }
  for (Eigen::Index k = half - 101; k + 2 < log.size(); ++k) {
    log.qd(k, 1) = (log.q(k + 1, 1) - log.q(k - 1, 1)) / .02;
    log.qdd(k, 1) =
        (log.q(k + 1, 1) - 2 * log.q(k, 1) + log.q(k - 1, 1)) / 1e-4;
  }
  log.qd.col(1).tail(2).setZero();
  log.qdd.col(1).tail(2).setZero();
  AddTorque(arm_.robot, &log);
  AddNoise(&random, .01 * ColumnRms(log.tau), &log.tau);
  log.qd.resize(0, 0);
  ASSERT_EQ(log.q(half + 5, 1), log.q(log.size() - 1, 1));
  EXPECT_TRUE(Frozen(log).empty());
}

// Of two joints and 8 s, half of them: what is fitted beside them is little,
// and what the torque says counts for one or two samples. No step of the
// position tells that it stopped.
TEST(FrozenChannels, AnEncoderThatStopsWhereItTurnsRoundIsTold) {
  InspectedArm arm("2R planar (vertical plane)", 8);
  arm.log.qd.resize(0, 0);
  const Eigen::VectorXd q = arm.log.q.col(0);
  Eigen::Index row = 300;
  while ((q[row] - q[row - 1]) * (q[row + 1] - q[row]) > 0) ++row;
  arm.log.q.col(0).segment(row, 400).setConstant(q[row]);
  const auto frozen =
      FindFrozenChannels(arm.robot, arm.log, {arm.log, .01, .05, 8});
  ASSERT_EQ(frozen.size(), 1u);
  EXPECT_TRUE(frozen[0].is_position);
  EXPECT_EQ(frozen[0].joint, 0);
}

}  // namespace armcal::frozen_channels_test
