#include "model/signals/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/signals/low_pass.h"
#include "tests/fixtures/cut_log.h"

namespace armcal::trajectory_test {

using Eigen::MatrixXd;

// Cores lie side by side from a segment's first grid point to its last.
long ExpectTiles(const std::vector<Trajectory>& parts) {
  long next = 0;
  int segment = -1;
  for (const Trajectory& t : parts) {
    if (t.segment != segment) next = 0;
    segment = t.segment;
    EXPECT_EQ(t.first_index + t.core_begin, next);
    EXPECT_LE(t.core_end, t.size());
    EXPECT_LT(t.core_begin, t.core_end);
    next = t.first_index + t.core_end;
  }
  return next;
}

// The whole signal at once is what any cutting must give.
TEST(TrajectoryReader, CuttingChangesNothing) {
  const double dt = .001, bandwidth = 5;
  const LogFile log = MakeLog(100, dt, Position, 1e-3);
  const int thin = 12;  // 1 kHz / (16 * 5 Hz) = 12.5
  const MatrixXd q =
      ZeroPhaseLowPass(log.q, 1 / dt, bandwidth, Ends::kExtrapolate);
  const MatrixXd qd = Differentiate(q, dt), qdd = Differentiate(qd, dt);
  const MatrixXd tau = ZeroPhaseLowPass(log.tau, 1 / dt, 4 * bandwidth);
  const auto parts = Cut(log.path, Bandwidth(bandwidth, .3));
  EXPECT_GE(parts.size(), 5);
  EXPECT_EQ(ExpectTiles(parts), (100000 + thin - 1) / thin);
  for (const Trajectory& t : parts) {
    EXPECT_NEAR(t.dt, thin * dt, 1e-12);
    EXPECT_LT(t.size() * t.dt, 40);  // bounded
    EXPECT_EQ(t.segment, 0);
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const long row = (t.first_index + k) * thin;
      ASSERT_NEAR(t.time(k), row * dt, 1e-9);
      ASSERT_NEAR(t.q(k, 0), q(row, 0), 1e-8);
      ASSERT_NEAR(t.qd(k, 0), qd(row, 0), 1e-8);
      ASSERT_NEAR(t.qdd(k, 0), qdd(row, 0), 1e-6);
      ASSERT_NEAR(t.tau(k, 0), tau(row, 0), 1e-8);
      ASSERT_FALSE(t.standstill[k]);
    }
    // The margins reach 0.3 s (rows) beyond the core, or to the log's end.
    EXPECT_TRUE(t.first_index == 0 || t.core_begin * t.dt > .3);
    EXPECT_TRUE(&t == &parts.back() || (t.size() - t.core_end) * t.dt > .3);
  }
}

// What friction changes sign with is low-passed elsewhere than the motion, and
// cut and thinned alike.
TEST(TrajectoryReader, FrictionHasAMotionOfItsOwn) {
  const double dt = .001, bandwidth = 5, wide = 17, wider = 20;
  const LogFile log = MakeLog(100, dt, Position, 1e-3);
  const auto low_passed = [&](double hz) {
    return ZeroPhaseLowPass(log.q, 1 / dt, hz, Ends::kExtrapolate);
  };
  const MatrixXd q = low_passed(wider),
                 qd = Differentiate(low_passed(wide), dt);
  TrajectoryOptions options = Bandwidth(bandwidth, .3);
  options.friction = {wider, wide};
  for (const Trajectory& t : Cut(log.path, options)) {
    ASSERT_EQ(t.friction_q.rows(), t.size());
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const long row = std::lround(t.time(k) / dt);
      ASSERT_NEAR(t.friction_q(k, 0), q(row, 0), 1e-8);
      ASSERT_NEAR(t.friction_qd(k, 0), qd(row, 0), 1e-7);
    }
  }
  for (const Trajectory& t : Cut(log.path, Bandwidth(bandwidth, .3))) {
    EXPECT_EQ(t.friction_q.size(), 0);
  }
}

// Also of a log whose stamps jitter, where the grid is interpolated.
TEST(TrajectoryReader, ResamplesJitter) {
  std::string text = "t,q1,tau1\n";
  for (int k = 0; k < 8000; ++k) {
    const double t = .005 * k + .002 * (Noise(k) - Noise(0));
    char line[120];
    std::snprintf(line, sizeof(line), "%.7f,%.17g,%.17g\n", t, Position(t),
                  Torque(t));
    text += line;
  }
  const auto parts = Cut(WriteFile(text), Bandwidth(0));
  EXPECT_GE(parts.size(), 2);
  ExpectTiles(parts);
  for (const Trajectory& t : parts) {
    for (int k = t.core_begin + 2; k + 2 < t.core_end; ++k) {
      ASSERT_NEAR(t.q(k, 0), Position(t.time(k)), 1e-6);
      ASSERT_NEAR(t.tau(k, 0), Torque(t.time(k)), 3e-3);
    }
  }
}

TEST(TrajectoryReader, WithoutABandwidthTakesTheLogAsItIs) {
  const LogFile log = MakeLog(20, .01, Position, 1e-3, {}, true);
  const auto parts = Cut(log.path, Bandwidth(0));
  ASSERT_EQ(ExpectTiles(parts), 2000);
  for (const Trajectory& t : parts) {
    const long n = t.size();
    EXPECT_EQ(t.q.col(0), log.q.segment(t.first_index, n));
    EXPECT_EQ(t.tau.col(0), log.tau.segment(t.first_index, n));
    EXPECT_EQ(t.qd, MatrixXd::Constant(n, 1, .25));
    EXPECT_EQ(t.qdd, MatrixXd::Constant(n, 1, -4));
  }
}

TEST(TrajectoryReader, ThinsOnlyFastLogs) {
  const auto step = [](double dt, double bandwidth) {
    const LogFile log = MakeLog(6, dt, Position);
    return Cut(log.path, Bandwidth(bandwidth)).front().dt;
  };
  EXPECT_NEAR(step(.001, 10), .006, 1e-12);  // 6.25
  EXPECT_NEAR(step(.002, 4), .014, 1e-12);   // 7.8
  EXPECT_NEAR(step(.01, 4), .01, 1e-12);     // 1.6
  EXPECT_NEAR(step(.001, 0), .001, 1e-12);
}

// Stretches overlap; each wrong sample is left out of all and counted once.
TEST(TrajectoryReader, WrongPositionsAreLeftOut) {
  const int wrong[] = {1200, 30005, 61234, 61235};
  const auto spoilt = [&](double t) {
    const auto k = std::lround(t / .001);
    return Position(t) + (std::count(wrong, wrong + 4, k) > 0 ? 1 : 0);
  };
  const auto clean = Cut(MakeLog(100, .001, Position).path, Bandwidth(5));
  const auto mended = Cut(MakeLog(100, .001, spoilt).path, Bandwidth(5));
  ASSERT_EQ(mended.size(), clean.size());
  long removed = 0;
  for (size_t k = 0; k < clean.size(); ++k) {
    EXPECT_EQ(clean[k].position_spikes.sum(), 0);
    removed += mended[k].position_spikes.sum();
    EXPECT_LT((mended[k].q - clean[k].q).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_LT((mended[k].qdd - clean[k].qdd).cwiseAbs().maxCoeff(), 1e-2);
  }
  EXPECT_EQ(removed, 4);
}

}  // namespace armcal::trajectory_test
