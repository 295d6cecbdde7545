#include "model/signals/resampler.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::resampler_test {

double Cubic(double t) { return 1 - 2 * t + .5 * t * t + 3 * t * t * t; }

// Two joints; signals that can be told apart.
Log MakeLog(const std::vector<double>& times, double (*f)(double)) {
  const int n = static_cast<int>(times.size());
  Log log;
  log.t = Eigen::Map<const Eigen::VectorXd>(times.data(), n);
  log.q.resize(n, 2);
  log.tau.resize(n, 2);
  for (int k = 0; k < n; ++k) {
    const double x = f(times[k]);
    log.q.row(k) << x, 2 * x;
    log.tau.row(k) << 10 + x, -x;
  }
  return log;
}

std::vector<double> Jittered(int n, double dt) {
  std::vector<double> times;
  for (int k = 0; k < n; ++k) {
    times.push_back(.5 + dt * (k + (k == 0 ? 0 : .3 * std::sin(5.0 * k))));
  }
  return times;
}

Resampler Fill(const Log& log, double dt, bool uniform) {
  Resampler resampler(dt, uniform);
  for (int k = 0; k < log.size(); ++k) resampler.Append(log, k);
  return resampler;
}

TEST(Resampler, IsExactOnCubics) {
  const double dt = .01;
  const Log log = MakeLog(Jittered(200, dt), Cubic);
  const Resampler resampler = Fill(log, dt, false);
  EXPECT_EQ(resampler.first_time(), .5);
  EXPECT_EQ(resampler.last_time(), log.t[199]);
  const long n = resampler.NumGridPoints();
  EXPECT_LE(.5 + static_cast<double>(n - 1) * dt, log.t[199] + 1e-9);
  EXPECT_GT(.5 + static_cast<double>(n) * dt, log.t[199]);
  Log out;
  resampler.Sample(0, n, &out);
  ASSERT_EQ(out.t.size(), n);
  EXPECT_EQ(out.qd.size(), 0);
  for (int k = 0; k < n; ++k) {
    EXPECT_NEAR(out.t[k], .5 + k * dt, 1e-12);
    const double x = Cubic(.5 + k * dt);
    EXPECT_NEAR(out.q(k, 0), x, 1e-9);
    EXPECT_NEAR(out.q(k, 1), 2 * x, 1e-9);
    EXPECT_NEAR(out.tau(k, 0), 10 + x, 1e-9);
    EXPECT_NEAR(out.tau(k, 1), -x, 1e-9);
  }
}

// Fourth order on what is not a cubic.
TEST(Resampler, ErrorFallsWithTheFourthPower) {
  double error[2];
  for (const int fine : {0, 1}) {
    const double dt = fine ? .01 : .02;
    const int count = fine ? 400 : 200;
    const Resampler resampler = Fill(
        MakeLog(Jittered(count, dt), [](double t) { return std::sin(4 * t); }),
        dt, false);
    Log out;
    resampler.Sample(0, resampler.NumGridPoints(), &out);
    error[fine] = 0;
    for (int k = 2; k + 2 < out.size(); ++k) {
      error[fine] =
          std::max(error[fine], std::abs(out.q(k, 0) - std::sin(4 * out.t[k])));
    }
  }
  EXPECT_NEAR(error[0] / error[1], 16, 3);
}

// Halfway between samples the cubic through the four nearest errs by 9/384 h^4
// times the fourth derivative.
TEST(Resampler, TakesTheNearestSamples) {
  const double h = .02;
  std::vector<double> times = {0};
  for (int k = 1; k < 200; ++k) times.push_back(h * (k - .5));
  const Resampler resampler =
      Fill(MakeLog(times, [](double t) { return std::sin(4 * t); }), h, false);
  Log out;
  resampler.Sample(0, resampler.NumGridPoints(), &out);
  for (int k = 3; k < 190; ++k) {
    EXPECT_NEAR(out.q(k, 0) - std::sin(4 * k * h),
                -9.0 / 384 * std::pow(4 * h, 4) * std::sin(4 * k * h), 2e-8);
  }
}

TEST(Resampler, PassesUniformSamplesAsTheyAre) {
  std::vector<double> times;
  for (int k = 0; k < 300; ++k) times.push_back(.1 + .01 * k);
  Log log = MakeLog(times, [](double t) { return std::fmod(1e6 * t, 1.7); });
  log.qd = 3 * log.q;
  log.qdd = -log.tau;
  const Resampler resampler = Fill(log, .01, true);
  ASSERT_EQ(resampler.NumGridPoints(), 300);
  Log out;
  resampler.Sample(0, 300, &out);
  EXPECT_EQ(out.q, log.q);
  EXPECT_EQ(out.tau, log.tau);
  EXPECT_EQ(out.qd, log.qd);
  EXPECT_EQ(out.qdd, log.qdd);
  resampler.Sample(17, 19, &out);
  EXPECT_EQ(out.q, log.q.middleRows(17, 2));
  EXPECT_NEAR(out.t[0], .27, 1e-12);
}

// A window that slides over the log gives what the whole log gives.
TEST(Resampler, ForgetsOnlyWhatNobodyNeeds) {
  for (const bool uniform : {false, true}) {
    const double dt = .01;
    std::vector<double> times = Jittered(1000, dt);
    for (int k = 0; uniform && k < 1000; ++k) times[k] = .5 + dt * k;
    const Log log = MakeLog(times, [](double t) { return std::sin(4 * t); });
    const Resampler all = Fill(log, dt, uniform);
    Resampler window(dt, uniform);
    Log out, expected;
    long next = 0;
    for (int k = 0; k < log.size(); ++k) {
      window.Append(log, k);
      if (window.NumGridPoints() < next + 60) continue;
      window.Sample(next, next + 50, &out);
      all.Sample(next, next + 50, &expected);
      ASSERT_EQ(out.q, expected.q) << next;
      ASSERT_EQ(out.t, expected.t);
      next += 50;
      window.DropBefore(next);
    }
    EXPECT_GE(next, 900);
    EXPECT_EQ(window.first_time(), .5);
  }
}

// Stamps may drift against the mean step by many samples although every step
// is within 1e-3 of it: 40 s at 1 kHz, the second half 0.05 % slower.
TEST(Resampler, DropsByIndexWhereStampsDrift) {
  std::vector<double> times = {0};
  for (int k = 1; k < 40000; ++k) {
    times.push_back(times.back() + (k < 20000 ? .001 : .0010005));
  }
  const Log log = MakeLog(times, [](double t) { return std::sin(t); });
  Resampler resampler = Fill(log, times.back() / 39999, true);
  for (const long index : {5000, 19990, 20000, 30000}) {
    resampler.DropBefore(index);
    Log out;
    resampler.Sample(index, index + 1, &out);
    ASSERT_EQ(out.q(0, 0), log.q(static_cast<int>(index), 0)) << index;
  }
}

TEST(Resampler, TakesShortSegmentsAndClears) {
  const auto line = [](double t) { return 3 - t; };
  Log log = MakeLog({0, .011, .019}, line);
  Resampler resampler = Fill(log, .01, false);
  ASSERT_EQ(resampler.NumGridPoints(), 2);
  Log out;
  resampler.Sample(0, 2, &out);
  EXPECT_NEAR(out.q(1, 0), 2.99, 1e-12);
  EXPECT_EQ(out.q(0, 0), 3);
  resampler.Clear();
  EXPECT_TRUE(resampler.empty());
  EXPECT_EQ(resampler.NumGridPoints(), 0);
  log = MakeLog({7}, line);
  resampler.Append(log, 0);
  EXPECT_EQ(resampler.first_time(), 7);
  EXPECT_EQ(resampler.NumGridPoints(), 1);
  resampler.Sample(0, 1, &out);
  EXPECT_EQ(out.q(0, 0), -4);
}

// A microsecond between two samples, as when messages arrive late and at once:
// the noise of a sample must not be multiplied.
TEST(Resampler, NearlyEqualStampsMakeNoSpikes) {
  const double dt = .01;
  std::vector<double> times;
  for (int k = 0; k < 50; ++k) {
    times.push_back(k % 7 == 3 ? (k + 1) * dt - 1e-6 : k * dt);
  }
  Log log = MakeLog(times, [](double) { return 0.; });
  for (int k = 0; k < log.size(); ++k) log.q(k, 0) = k % 2 == 0 ? 1 : -1;
  const Resampler resampler = Fill(log, .99 * dt, false);
  Log out;
  resampler.Sample(0, resampler.NumGridPoints(), &out);
  EXPECT_LE(out.q.col(0).cwiseAbs().maxCoeff(), 10);
}

}  // namespace armcal::resampler_test
