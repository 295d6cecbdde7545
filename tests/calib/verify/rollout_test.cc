#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "calib/verify/rollout_figures.h"
#include "calib/verify/simbody_rollouts.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::rollout_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A 3R arm with viscous friction that moves for 10 s in a first log and rests
// for 5 s in a second.
class RolloutLogs : public testing::Test {
 protected:
  RolloutLogs() : truth_(SampleRobot("3R elbow")) {
    SetRandomInertials(&random_, &truth_);
    for (Link& link : truth_.links) {
      link.joint.viscous = 1;
      link.joint.armature = .2;
    }
    Multisine motion = RandomMultisine(&random_, 3);
    Log moving = RecordMotion(motion, 10, .005);
    AddTorque(truth_, &moving);
    motion.amplitude.setZero();
    Log resting = RecordMotion(motion, 5, .005);
    AddTorque(truth_, &resting);
    LogReaderOptions reader;
    reader.joint_names = truth_.JointNames();
    logs_.emplace(LogFiles({WriteFile(LogCsv(moving, true), "moving.csv"),
                            WriteFile(LogCsv(resting, true), "resting.csv")}),
                  reader, TimeRange());
  }

  std::vector<Rollouts> Run(const std::vector<Robot>& robots,
                            RolloutOptions options = {}) {
    std::vector<RolloutModel> models;
    for (const Robot& robot : robots) {
      models.push_back({robot, std::vector<CoulombTransition>(3)});
    }
    return RollOut(models, options, 0, *logs_);
  }

  std::mt19937_64 random_{3};
  Robot truth_;
  std::optional<LogSet> logs_;
};

// An offset of a joint's torque moves a link of inertia M by t^2 / 2 offset / M
// in a short time; the truth stays where the log is.
TEST_F(RolloutLogs, TheTruthIsNearAndAnErrorShowsAtItsSize) {
  Robot wrong = truth_;
  wrong.links[2].joint.offset = .3;
  const std::vector<Rollouts> all = Run({truth_, wrong});
  ASSERT_EQ(all.size(), 3u);
  const std::vector<int> joints = {0, 1, 2};
  // Windows side by side; those that rest are told apart.
  EXPECT_EQ(all[0].windows.size(), 50u);
  EXPECT_EQ(all[1].windows.size(), 20u);
  EXPECT_EQ(all[2].windows.size(), 10u);
  EXPECT_EQ(all[0].standstill, 25);
  EXPECT_EQ(all[2].standstill, 5);
  EXPECT_LT(MedianError(all[2], 0, joints, 1).value, 1e-4);
  EXPECT_EQ(all[0].NumDiverged(1), 0);
  // At rest joint 3 alone would get qdd = offset / (M33 + armature); friction
  // and the other joints take their share, in .2 s less than half.
  const double least = truth_.links[2].inertial.inertia(2, 2) + .2;
  const double free = .3 / least * .2 * .2 / 2 / std::sqrt(5);  // rms of t^2
  const double found = MedianError(all[0], 1, {2}, 1).value;
  EXPECT_LT(found, 1.5 * free);
  EXPECT_GT(found, .3 * free);
  const RolloutFigure ratio = MedianRatio(all[0], 0, 1, joints, 1);
  EXPECT_LT(ratio.high, .1);
}

// Without a limit Simbody simulates every window, and its errors count.
TEST_F(RolloutLogs, SimbodySimulatesAllThatItHasTimeFor) {
  Robot wrong = truth_;
  wrong.links[2].joint.offset = .3;
  RolloutOptions options;
  const std::vector<Rollouts> own = Run({truth_, wrong});
  options.simbody_s = kInfinity;
  const std::vector<Rollouts> all = Run({truth_, wrong}, options);
  for (size_t k = 0; k < all.size(); ++k) {
    const Rollouts& r = all[k];
    EXPECT_EQ(r.in_simbody, 2 * static_cast<int>(r.windows.size()));
    EXPECT_EQ(r.unfinished_in_simbody, 0);
    EXPECT_LT(r.simbody_difference, 1e-5);
    EXPECT_GT(r.simbody_difference, 0);
    for (size_t w = 0; w < r.windows.size(); ++w) {
      const RolloutWindow& window = r.windows[w];
      EXPECT_EQ(window.simbody, (std::vector<int>{0, 1}));
      EXPECT_EQ(window.own_q, own[k].windows[w].q);
      EXPECT_NE(window.q, window.own_q);
      EXPECT_LT((window.q - window.own_q).cwiseAbs().maxCoeff(), 1e-5);
    }
  }
}

// With no time at all it simulates a window of each length in each stretch; the
// rest are ours.
TEST_F(RolloutLogs, WithoutTimeSimbodySimulatesOneWindowOfEachLength) {
  RolloutOptions options;
  options.simbody_s = 0;
  for (const Rollouts& r : Run({truth_}, options)) {
    EXPECT_EQ(r.in_simbody, 1);
    EXPECT_EQ(MedianErrorsByEngine(r, 0, {0, 1, 2}).windows, 1);
    EXPECT_TRUE(r.windows[0].in_simbody(0));
    EXPECT_EQ(r.windows.back().q, r.windows.back().own_q);
  }
}

// Each beginning of the order is spread over all windows: of its first 2^k no
// gap is longer than 2^-k of them, and lengths take turns.
TEST(SpreadOrder, IsEvenHoweverFarOneComes) {
  std::vector<int> indices(64);
  std::iota(indices.begin(), indices.end(), 0);
  const std::vector<int> order = SpreadOrder(indices);
  for (int count = 1; count <= 64; count *= 2) {
    std::vector<int> first(order.begin(), order.begin() + count);
    std::sort(first.begin(), first.end());
    for (int k = 0; k < count; ++k) EXPECT_EQ(first[k], k * 64 / count);
  }
  EXPECT_EQ(SpreadOrder({0, 1, 0, 1}), (std::vector<int>{0, 2, 1, 3}));
}

// A spinning joint that nothing brakes ends early in every window: its error
// has no bound, and the other model's is not touched.
TEST_F(RolloutLogs, DivergedWindowsAreCounted) {
  Robot wild = truth_;
  wild.links[2].inertial = {};
  wild.links[2].joint.armature = 0;
  RolloutOptions in_simbody;
  in_simbody.simbody_s = kInfinity;
  for (const RolloutOptions& options : {RolloutOptions(), in_simbody}) {
    const Rollouts r = Run({truth_, wild}, options)[0];
    EXPECT_EQ(r.NumDiverged(0), 0);
    EXPECT_EQ(r.NumDiverged(1), 50);
    EXPECT_EQ(MedianError(r, 1, {0}, 1).value, kInfinity);
    EXPECT_LT(MedianError(r, 0, {0}, 1).value, 1e-4);
    // By neither engine: there is nothing to compare.
    EXPECT_EQ(r.compared, options.simbody_s ? 50 : 0);
    EXPECT_LT(r.simbody_difference, 1e-5);
  }
}

// Simbody is asked of a window that ours, as told here, does not leave; it
// leaves the log, which is not for want of steps.
TEST(SimbodyRollouts, SaysThatARobotIsLost) {
  std::mt19937_64 random(3);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  Trajectory t;
  t.dt = .01;
  t.q = t.qd = t.qdd = MatrixXd::Zero(101, 3);
  t.tau = MatrixXd::Constant(101, 3, 1e4);  // N m
  t.core_end = 101;
  const std::vector<RolloutModel> models = {
      {robot, std::vector<CoulombTransition>(3)}};
  RolloutOptions options;
  options.simbody_s = kInfinity;
  const WindowTask task{0, 100, {VectorXd::Zero(3)}, {MatrixXd::Zero(100, 3)}};
  SimbodyRollouts simbody(models, options, 101);
  const auto answers = simbody.Run(t, 101, {task}, {0}, 1);
  EXPECT_EQ(answers[0].states[0], SimbodyAnswer::State::kLost);
}

// The integration's error is far below what is measured.
TEST_F(RolloutLogs, ToleranceIsFineEnough) {
  Robot wrong = truth_;
  wrong.links[1].joint.viscous = 2;
  RolloutOptions finer;
  finer.tolerance = 1e-10;
  const double coarse = MedianError(Run({wrong})[2], 0, {0, 1, 2}, 1).value;
  const double fine =
      MedianError(Run({wrong}, finer)[2], 0, {0, 1, 2}, 1).value;
  EXPECT_GT(fine, 1e-3);
  EXPECT_NEAR(coarse, fine, 1e-3 * fine);
}

// Windows of one joint with these errors for two models.
Rollouts WithErrors(const std::vector<double>& errors, double factor) {
  Rollouts rollouts{.2, {}};
  for (const double error : errors) {
    MatrixXd q(2, 1);
    q << error, factor * error;
    rollouts.windows.push_back({0, 0, q, q, q, {}});
  }
  return rollouts;
}

TEST(RolloutFigures, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(MedianError(WithErrors({5, 1, 3}, 1), 0, {0}, 1).value, 3);
  EXPECT_EQ(MedianError(WithErrors({5, 1, 3, 4}, 1), 0, {0}, 1).value, 3.5);
  EXPECT_EQ(MedianError(WithErrors({1, kInfinity, 3}, 1), 0, {0}, 1).value, 3);
}

// The same windows are drawn for both: a constant ratio has no spread.
TEST(RolloutFigures, RatioIsOfPairs) {
  std::mt19937_64 random(1);
  std::vector<double> errors;
  for (int k = 0; k < 40; ++k) errors.push_back(Uniform(&random, 1, 9));
  const RolloutFigure ratio = MedianRatio(WithErrors(errors, 4), 0, 1, {0}, 1);
  EXPECT_NEAR(ratio.low, .25, 1e-12);
  EXPECT_NEAR(ratio.high, .25, 1e-12);
}

// A steady drift makes one block of all windows, however many there are.
TEST(RolloutFigures, CorrelatedWindowsAreNotJudged) {
  std::vector<double> drifting, independent;
  std::mt19937_64 random(4);
  for (int k = 0; k < 100; ++k) {
    drifting.push_back(1 + .01 * k);
    independent.push_back(Uniform(&random, 0, 1));
  }
  EXPECT_FALSE(MedianError(WithErrors(drifting, 1), 0, {0}, 1).can_judge());
  EXPECT_TRUE(MedianError(WithErrors(independent, 1), 0, {0}, 1).can_judge());
  independent.resize(20);  // cube root 2.7: blocks of 3
  EXPECT_FALSE(MedianError(WithErrors(independent, 1), 0, {0}, 1).can_judge());
  EXPECT_FALSE(MedianError(WithErrors({}, 1), 0, {0}, 1).can_judge());
}

}  // namespace armcal::rollout_test
