#include "calib/logs/sample_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/fixtures/inspected_arm.h"

namespace armcal::sample_clock_test {

using Eigen::VectorXd;

// An arm that is recorded every 10 ms, its positions with noise of 2e-5 rad.
class SampleClockTest : public testing::Test {
 protected:
  SampleClockTest() {
    std::mt19937_64 random(11);
    AddNoise(&random, VectorXd::Constant(log_.q.cols(), 2e-5), &log_.q);
  }

  void Keep(const std::vector<int>& rows) {
    log_.t = VectorXd(log_.t(rows));
    log_.q = Eigen::MatrixXd(log_.q(rows, Eigen::all));
    log_.qd = Eigen::MatrixXd(log_.qd(rows, Eigen::all));
  }
  // Bursts of three rows are lost, one row in sixteen; true times.
  VectorXd HideHoles() {
    const VectorXd stamps = log_.t;
    std::vector<int> rows;
    for (int k = 0; k < log_.size(); ++k) {
      if (k % 48 < 45) rows.push_back(k);
    }
    Keep(rows);
    const VectorXd truth = log_.t;
    log_.t = stamps.head(truth.size());
    return truth;
  }

  Log log_ = InspectedArm().log;
};

TEST_F(SampleClockTest, ARightClockIsRight) {
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_GE(clock.windows, 100);
  EXPECT_FALSE(clock.wrong());
  EXPECT_NEAR(clock.period, .01, 1e-5);
  EXPECT_EQ(clock.t.size(), 0);
}

// Velocities at a hole's ends say nothing of the time in between.
TEST_F(SampleClockTest, HolesThatStampsTellAreRight) {
  std::vector<int> rows;
  for (int k = 0; k < log_.size(); ++k) {
    if (k % 150 < 125) rows.push_back(k);
  }
  Keep(rows);
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_GE(clock.windows, 20);
  EXPECT_FALSE(clock.wrong());
}

TEST_F(SampleClockTest, ARateIsFound) {
  log_.t /= 1.03;
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_TRUE(clock.wrong_rate);
  EXPECT_FALSE(clock.uneven);
  EXPECT_NEAR(clock.rate, 1.03, .001);
  EXPECT_NEAR(clock.period, .01, 1e-5);
  EXPECT_LT(clock.period_stddev, 1e-5);
  ASSERT_EQ(clock.t.size(), log_.size());
  EXPECT_NEAR(clock.t[log_.size() - 1], 1.03 * log_.t[log_.size() - 1], .02);
}

TEST_F(SampleClockTest, HolesThatStampsHideAreFoundAndMended) {
  const VectorXd truth = HideHoles();
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_TRUE(clock.uneven);
  EXPECT_NEAR(clock.period, .01 * 48 / 45, 5e-5);
  EXPECT_NEAR(clock.skipped, truth.size() / 45, .1 * truth.size() / 45);
  // Each step to a twentieth of the usual one, all of them together to .1 %.
  const auto steps = [](const VectorXd& t) -> VectorXd {
    return t.tail(t.size() - 1) - t.head(t.size() - 1);
  };
  const VectorXd error = steps(clock.t) - steps(truth);
  EXPECT_LT(std::sqrt(error.squaredNorm() / error.size()), 5e-4);
  EXPECT_LT((clock.t - truth).cwiseAbs().maxCoeff(), 1e-3 * truth.maxCoeff());
}

// Stamps that are up to 1 ms off, each by itself, of rows that were taken every
// 10 ms: the mean is right, and each step is known to a fifth of that.
TEST_F(SampleClockTest, StampsThatJitterAreToldFromTheJoints) {
  const VectorXd truth = log_.t;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> off(-1e-3, 1e-3);
  for (double& t : log_.t) t += off(random);
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_FALSE(clock.wrong());
  EXPECT_TRUE(clock.jitters);
  // A step has the errors of two stamps, each of 1 ms / sqrt(3) in the rms.
  EXPECT_NEAR(clock.jitter, 1e-3 * std::sqrt(2. / 3), 5e-5);
  ASSERT_EQ(clock.t.size(), truth.size());
  const auto rms_of_steps = [&](const VectorXd& t) {
    const VectorXd error = t - truth;
    const Eigen::Index steps = error.size() - 1;
    return std::sqrt((error.tail(steps) - error.head(steps)).squaredNorm() /
                     static_cast<double>(steps));
  };
  EXPECT_LT(rms_of_steps(clock.t), .2 * rms_of_steps(log_.t));
  // Together they are off by less than a thousandth.
  EXPECT_LT((clock.t - truth).cwiseAbs().maxCoeff(), 1e-3 * truth.maxCoeff());
}

// An arm that moves for a second and rests for the next, when its rounded
// positions repeat and its velocities have noise: rests keep their length.
TEST_F(SampleClockTest, RestsKeepTheirLength) {
  std::mt19937_64 random(5);
  Eigen::MatrixXd noise = Eigen::MatrixXd::Zero(log_.size(), log_.q.cols());
  AddNoise(&random, VectorXd::Constant(log_.q.cols(), 1e-4), &noise);
  for (Eigen::Index k = 0; k < log_.size(); ++k) {
    const double t = log_.t[k], phase = std::fmod(t, 2.);
    const bool moves = phase < 1;
    // The integral of sin^2(pi t) from 0 on.
    const double way =
        std::floor(t / 2) / 2 +
        (moves ? phase / 2 - std::sin(2 * M_PI * phase) / (4 * M_PI) : .5);
    const double speed = moves ? std::pow(std::sin(M_PI * phase), 2) : 0;
    for (Eigen::Index j = 0; j < log_.q.cols(); ++j) {
      log_.q(k, j) = 2e-5 * std::round(5e4 * static_cast<double>(1 + j) * way);
      log_.qd(k, j) = static_cast<double>(1 + j) * speed + noise(k, j);
    }
  }
  const VectorXd truth = log_.t;
  std::uniform_real_distribution<double> off(-1e-3, 1e-3);
  for (double& t : log_.t) t += off(random);
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_TRUE(clock.wrong());
  ASSERT_EQ(clock.t.size(), truth.size());
  EXPECT_LT((clock.t - truth).cwiseAbs().maxCoeff(), 1e-3 * truth.maxCoeff());
}

// Speeds of all joints are the same trapezoids in time, up and down by 5 s^-2:
// what the mean of both ends leaves of the step in which such a ramp ends all
// joints share, 1e-4 of a step of stamps that are right.
TEST_F(SampleClockTest, ExactTrapezoidsDoNotJitter) {
  double way = 0;
  for (Eigen::Index k = 0; k < log_.size(); ++k) {
    const auto speed = [](double t) {
      const double phase = std::fmod(t + .0037, 2.);
      const double up = std::min({5 * phase, 1., 5 * (1 - phase)});
      const double down = std::min({5 * (phase - 1), 1., 5 * (2 - phase)});
      return phase < 1 ? up : -down;
    };
    for (Eigen::Index j = 0; j < log_.q.cols(); ++j) {
      log_.q(k, j) = static_cast<double>(1 + j) * way;
      log_.qd(k, j) = static_cast<double>(1 + j) * speed(log_.t[k]);
    }
    for (int i = 0; i < 100; ++i) {
      way += 1e-4 * speed(log_.t[k] + 1e-4 * (i + .5));
    }
  }
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_GE(clock.windows, 20);
  EXPECT_FALSE(clock.jitters) << clock.jitter;
  EXPECT_FALSE(clock.wrong());
}

TEST_F(SampleClockTest, EvenStampsDoNotJitter) {
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_FALSE(clock.jitters);
  EXPECT_LT(clock.step_correlation, .5);
}

// The row before is repeated: it adds no time.
TEST_F(SampleClockTest, RepeatedRowsAreOfTheTimeBefore) {
  const VectorXd stamps = log_.t;
  std::vector<int> rows;
  for (int k = 0; k < log_.size(); ++k) rows.push_back(k % 5 == 4 ? k - 1 : k);
  Keep(rows);
  const VectorXd truth = log_.t;
  log_.t = stamps;
  log_.t.array() *= 1.02;
  const SampleClock clock = EstimateSampleClock(log_);
  ASSERT_TRUE(clock.wrong());
  for (int k = 4; k < log_.size(); k += 5) {
    EXPECT_EQ(clock.t[k], clock.t[k - 1]);
  }
  EXPECT_GT(clock.repeated, .9 * log_.size() / 5);
  EXPECT_NEAR(clock.t[log_.size() - 1], truth[log_.size() - 1], .02);
}

// What is one joint's affair is no clock.
TEST_F(SampleClockTest, VelocitiesOfOtherScaleAreNoClock) {
  const Log right = log_;
  for (int scaled = 1; scaled < 6; ++scaled) {
    log_ = right;
    log_.qd.leftCols(scaled) *= 1.06;
    EXPECT_FALSE(EstimateSampleClock(log_).wrong()) << scaled;
  }
}

TEST_F(SampleClockTest, LateVelocitiesAreNoClock) {
  const Eigen::Index size = log_.size() - 2;
  const Eigen::MatrixXd qd = log_.qd;
  log_.qd.bottomRows(size) = qd.topRows(size);
  EXPECT_FALSE(EstimateSampleClock(log_).wrong());
}

TEST_F(SampleClockTest, VelocitiesMadeByTheStampsTellNothing) {
  HideHoles();
  const Eigen::Index size = log_.size() - 1;
  for (Eigen::Index k = 0; k < size; ++k) {
    log_.qd.row(k + 1) =
        (log_.q.row(k + 1) - log_.q.row(k)) / (log_.t[k + 1] - log_.t[k]);
  }
  EXPECT_FALSE(EstimateSampleClock(log_).wrong());
}

TEST_F(SampleClockTest, OneJointTellsNothing) {
  log_.t /= 1.03;
  log_.q = log_.q.leftCols(1).eval();
  log_.qd = log_.qd.leftCols(1).eval();
  const SampleClock clock = EstimateSampleClock(log_);
  EXPECT_EQ(clock.windows, 0);
  EXPECT_FALSE(clock.wrong());
}

}  // namespace armcal::sample_clock_test
