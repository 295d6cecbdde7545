#include "calib/logs/torque_drift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace armcal::torque_drift_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStep = .04;
constexpr int kRows = 1150;  // 46 s

VectorXd Times() {
  return VectorXd::LinSpaced(kRows, 7, 7 + kStep * (kRows - 1));
}

// rms of what is left of a signal of time, of its own.
template <typename Signal>
double Left(const Signal& signal) {
  const VectorXd x = Times().unaryExpr(signal);
  const MatrixXd left = TorqueDrift(Times()).Without(x, VectorXd::Ones(kRows));
  return left.norm() / x.norm();
}

TEST(TorqueDrift, TakesOutWhatIsSlow) {
  EXPECT_LT(Left([](double) { return 5.; }), 1e-9);
  EXPECT_LT(Left([](double t) { return t; }), .02);
  EXPECT_LT(Left([](double t) { return std::sin(2 * M_PI * t / 40); }), .1);
}

// A level is taken out whatever it rests on, but it is no drift where rows that
// count for little are all that says so.
TEST(TorqueDrift, FollowsNoUncertainRows) {
  const VectorXd few = VectorXd::Constant(kRows, 1e-3);
  const VectorXd ramp = Times().array() - Times().mean();
  const VectorXd level = VectorXd::Constant(kRows, 5);
  const TorqueDrift drift(Times());
  EXPECT_LT(drift.Without(level, few).norm(), 1e-6);
  EXPECT_GT(drift.Without(ramp, few).norm(), .9 * ramp.norm());
}

TEST(TorqueDrift, LeavesWhatIsQuick) {
  for (const double hz : {.5, 2., 8.}) {
    EXPECT_GT(Left([&](double t) { return std::sin(2 * M_PI * hz * t); }), .97)
        << hz;
  }
}

// What joints do that stand still says nothing of the level, which goes on.
TEST(TorqueDrift, IsToldWhereRowsCount) {
  const VectorXd t = Times();
  VectorXd weights = VectorXd::Ones(kRows), x = VectorXd::Constant(kRows, 3);
  weights.head(100).setZero();
  weights.segment(500, 120).setZero();
  for (int k = 0; k < kRows; ++k) x[k] += weights[k] == 0 ? 10 : 0;
  const VectorXd left = TorqueDrift(t).Without(x, weights);
  for (int k = 0; k < kRows; ++k) {
    EXPECT_NEAR(left[k], weights[k] == 0 ? 10 : 0, 1e-6) << k;
  }
}

// One row that moves beside many that do not must not tilt the line.
TEST(TorqueDrift, IsNotTiltedBySingleRows) {
  VectorXd weights = VectorXd::Ones(kRows), x = VectorXd::Zero(kRows);
  weights.head(74).setZero();  // almost to the first knot
  x.segment(74, 4).setConstant(1);
  const VectorXd left = TorqueDrift(Times()).Without(x, weights);
  EXPECT_LT((left - x).head(74).cwiseAbs().maxCoeff(), .5);
}

TEST(TorqueDrift, OfNothing) {
  EXPECT_EQ(TorqueDrift(VectorXd()).Without(MatrixXd(0, 2), VectorXd()).rows(),
            0);
  const VectorXd still =
      TorqueDrift(Times()).Without(Times(), VectorXd::Zero(kRows));
  EXPECT_EQ(still, Times());
}

}  // namespace armcal::torque_drift_test
