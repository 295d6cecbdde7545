#include "calib/log_clocks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calib/inspect/stuck_rows.h"
#include "tests/fixtures/inspected_arm.h"

namespace armcal::log_clocks_test {

// An arm that is recorded every 10 ms, its positions with noise of 2e-5 rad,
// by two clocks: a right one, and one that runs 3 % slow.
class LogClocks : public testing::Test {
 protected:
  LogClocks() : right_("right", InspectedArm().log), slow_(right_) {
    Log log = InspectedArm().log;
    std::mt19937_64 random(11);
    AddNoise(&random, Eigen::VectorXd::Constant(log.q.cols(), 2e-5), &log.q);
    right_ = LogSource("right", log);
    log.t /= 1.03;
    slow_ = LogSource("slow", log);
    for (int j = 0; j < log.q.cols(); ++j) {
      reading_.joint_names.push_back("j" + std::to_string(j + 1));
    }
  }

  LogSource right_, slow_;
  LogReaderOptions reading_;
};

TEST_F(LogClocks, OfAnotherRateIsATimeBase) {
  const std::vector<WrongClock> clocks =
      MendClocks({right_, slow_}, reading_, &reading_);
  ASSERT_EQ(clocks.size(), 1);
  EXPECT_EQ(clocks[0].log, "slow");
  EXPECT_TRUE(clocks[0].finding.leads);
  EXPECT_EQ(reading_.sample_times.count("slow"), 1);
  EXPECT_EQ(reading_.sample_times.count("right"), 0);
  const std::optional<FoundEffect> effect = FoundClock(clocks, {slow_});
  ASSERT_TRUE(effect);
  EXPECT_EQ(effect->effect->name, "time_base");
  ASSERT_EQ(effect->estimates.size(), 1);
  EXPECT_NEAR(effect->estimates[0].value, 1 / 1.03 - 1, .001);
  EXPECT_NEAR(effect->estimates[0].value, 1 / 1.03 - 1, 4 * effect->stddev[0]);
}

// Stamps that jitter are mended, and are no reason to doubt laws.
TEST_F(LogClocks, OfStampsThatJitterLawsAreLookedFor) {
  Log log = InspectedArm().log;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-1e-3, 1e-3);
  for (double& t : log.t) t += off(random);
  const LogSource jitters("jitters", log);
  std::vector<WrongClock> clocks = MendClocks({jitters}, reading_, &reading_);
  ASSERT_EQ(clocks.size(), 1);
  EXPECT_FALSE(clocks[0].finding.leads);
  EXPECT_EQ(reading_.sample_times.count("jitters"), 1);
  EXPECT_FALSE(AreLawsInDoubt(clocks));
  EXPECT_FALSE(FoundClock(clocks, {jitters}));
  clocks = MendClocks({jitters, slow_}, reading_, &reading_);
  EXPECT_TRUE(AreLawsInDoubt(clocks));
}

// What jumps or stands still tells no time: by itself it hides the clock, and
// mended it does not. Rows that are left out have the time around.
TEST(LogClocksOfMendedPositions, AreTold) {
  InspectedArm arm("3R elbow");
  Log& log = arm.log;
  std::mt19937_64 random(11);
  AddNoise(&random, Eigen::VectorXd::Constant(3, 2e-5), &log.q);
  int at = 300;
  const auto gone = [&](int k) {
    return std::abs(log.q(k + 33, 1) - log.q(k, 1));
  };
  for (int k = 300; k < 1600; ++k) at = gone(k) > gone(at) ? k : at;
  log.q.col(1).segment(at, 33).setConstant(log.q(at, 1));
  const Eigen::VectorXd true_time = log.t;
  log.t /= 1.03;
  const LogSource source("slow", log);
  LogReaderOptions reading;
  reading.joint_names = arm.robot.JointNames();
  EXPECT_TRUE(MendClocks({source}, reading, &reading).empty());
  LogReaderOptions mended = reading;
  MendPositions(arm.robot, {{source, {}}}, &mended);
  ASSERT_EQ(mended.left_out["slow"].size(), 1u);
  ASSERT_EQ(MendClocks({source}, mended, &reading).size(), 1u);
  const Eigen::VectorXd& told = *reading.sample_times["slow"];
  ASSERT_EQ(told.size(), true_time.size());
  EXPECT_LT((told - true_time).cwiseAbs().maxCoeff(), .01);
}

// A reference's clock is no effect of the log that is diagnosed, nor are stamps
// that are uneven at the right rate.
TEST_F(LogClocks, OfOtherLogsOrAtTheRightRateIsNone) {
  std::vector<WrongClock> clocks =
      MendClocks({right_, slow_}, reading_, &reading_);
  ASSERT_EQ(clocks.size(), 1);
  EXPECT_FALSE(FoundClock(clocks, {right_}));
  EXPECT_FALSE(FoundClock({}, {slow_}));
  clocks[0].wrong_rate = false;
  EXPECT_FALSE(FoundClock(clocks, {slow_}));
}

}  // namespace armcal::log_clocks_test
