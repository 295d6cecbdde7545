#include "model/signals/low_pass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace armcal::low_pass_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;
constexpr double kRate = 1000;  // Hz

template <class Function>
VectorXd Samples(int n, double rate, const Function& f) {
  VectorXd x(n);
  for (int k = 0; k < n; ++k) x[k] = f(k / rate);
  return x;
}

// What the filter makes of exp(i 2 pi f t), from the middle half of 32 s.
std::complex<double> Response(double f, double cutoff) {
  const int n = 32000;
  MatrixXd x(n, 2);
  for (int k = 0; k < n; ++k) {
    x(k, 0) = std::cos(2 * kPi * f * k / kRate);
    x(k, 1) = std::sin(2 * kPi * f * k / kRate);
  }
  const MatrixXd y = ZeroPhaseLowPass(x, kRate, cutoff);
  std::complex<double> sum = 0;
  for (int k = n / 4; k < 3 * n / 4; ++k) {
    sum += std::complex<double>(y(k, 0), y(k, 1)) *
           std::complex<double>(x(k, 0), -x(k, 1));
  }
  return sum / (n / 2.0);
}

TEST(ZeroPhaseLowPass, HasTheButterworthGainAndNoPhase) {
  for (const double cutoff : {2.0, 5.0, 8.0}) {
    for (const double ratio : {.1, .5, .8, 1.0, 1.2, 2.0, 4.0}) {
      const auto H = Response(ratio * cutoff, cutoff);
      // |H|^2 of order 4; frequencies stay below 7 % of Nyquist's, where the
      // bilinear transform bends them by less than 0.4 %.
      const double analog = 1 / (1 + std::pow(ratio, 8));
      EXPECT_NEAR(H.real(), analog, .03 * analog) << ratio << " " << cutoff;
      const double bent = std::tan(kPi * ratio * cutoff / kRate) /
                          std::tan(kPi * cutoff / kRate);
      EXPECT_NEAR(H.real(), 1 / (1 + std::pow(bent, 8)), 1e-7);
      EXPECT_NEAR(H.imag(), 0, 1e-7);
    }
    EXPECT_NEAR(Response(cutoff, cutoff).real(), .5, 1e-7);
  }
}

TEST(ZeroPhaseLowPass, PassesConstantsAndRampsUpToTheEnds) {
  for (const int n : {2, 3, 10, 500, 5000}) {
    const VectorXd constant = VectorXd::Constant(n, 3.25);
    EXPECT_EQ(ZeroPhaseLowPass(constant, kRate, 5), constant) << n;
  }
  for (const double cutoff : {4.0, 20.0}) {
    const VectorXd ramp = Samples(10000, kRate, [](double t) { return 2 * t; });
    const VectorXd error = ZeroPhaseLowPass(ramp, kRate, cutoff) - ramp;
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8) << cutoff;
  }
}

// Two microseconds say nothing of 20 Hz, whose filter would start from rest
// 40 million samples outside.
TEST(ZeroPhaseLowPass, LeavesWhatIsFarShorterThanAPeriod) {
  const VectorXd x = VectorXd::LinSpaced(200, -1, 1).array().square();
  EXPECT_EQ(ZeroPhaseLowPass(x, 1e8, 20, Ends::kExtrapolate), x);
}

// What keeps curving at the ends of a log: motion, not noise.
TEST(ZeroPhaseLowPass, ExtrapolatedEndsKeepCurving) {
  const double rate = 200, cutoff = 6;
  VectorXd motion(800), cubic(800);
  for (int k = 0; k < 800; ++k) {
    const double t = k / rate;
    motion[k] = std::sin(2 * kPi * 0.5 * t + 0.4);
    cubic[k] = 1 - 2 * t + 3 * t * t - 0.5 * t * t * t;
  }
  EXPECT_LT((ZeroPhaseLowPass(cubic, rate, cutoff, Ends::kExtrapolate) - cubic)
                .cwiseAbs()
                .maxCoeff(),
            1e-8);
  const auto error = [&](Ends ends) {
    return (ZeroPhaseLowPass(motion, rate, cutoff, ends) - motion)
        .cwiseAbs()
        .maxCoeff();
  };
  EXPECT_LT(error(Ends::kExtrapolate), 1e-4);
  EXPECT_GT(error(Ends::kReflect), 20 * error(Ends::kExtrapolate));
}

TEST(ZeroPhaseLowPass, IsLinearAndTreatsColumnsApart) {
  MatrixXd x(400, 3);
  x.col(0) = Samples(400, 100, [](double t) { return std::sin(9 * t); });
  x.col(1) = Samples(400, 100, [](double t) { return t * t; });
  x.col(2) = 2 * x.col(0) - 5 * x.col(1);
  const MatrixXd y = ZeroPhaseLowPass(x, 100, 3);
  EXPECT_LT((y.col(2) - 2 * y.col(0) + 5 * y.col(1)).cwiseAbs().maxCoeff(),
            1e-11);
  EXPECT_EQ(y.col(1), ZeroPhaseLowPass(x.col(1), 100, 3).col(0));
}

TEST(ZeroPhaseLowPass, LeavesDataAloneThatNeedsNoFilter) {
  const VectorXd x = Samples(50, 1, [](double t) { return std::fmod(t, 7); });
  EXPECT_EQ(ZeroPhaseLowPass(x, 100, 50), x);
  EXPECT_EQ(ZeroPhaseLowPass(x, 100, 1000), x);
  EXPECT_EQ(ZeroPhaseLowPass(x.head(1), 100, 5), x.head(1));
  EXPECT_EQ(ZeroPhaseLowPass(MatrixXd(0, 3), 100, 5).rows(), 0);
  EXPECT_NE(ZeroPhaseLowPass(x, 100, 40), x);
}

// An impulse spreads symmetrically, keeps its area, and is below 1e-9 of its
// height after LowPassMemory.
TEST(LowPassMemory, IsWhenAnImpulseIsForgotten) {
  const double rate = 2000;
  for (const double cutoff : {2.0, 5.0, 20.0, 80.0}) {
    const int memory =
        static_cast<int>(std::ceil(LowPassMemory(cutoff) * rate));
    const int middle = 2 * memory;
    VectorXd x = VectorXd::Zero(2 * middle + 1);
    x[middle] = 1;
    const VectorXd y = ZeroPhaseLowPass(x, rate, cutoff);
    EXPECT_NEAR(y.sum(), 1, 1e-7);
    EXPECT_LT((y - y.reverse()).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT(y.head(middle - memory).cwiseAbs().maxCoeff(), 1e-9) << cutoff;
    EXPECT_LT(y.tail(middle - memory).cwiseAbs().maxCoeff(), 1e-9) << cutoff;
    // Not far too long either: half of it is not enough.
    EXPECT_GT(y.head(middle - memory / 2).cwiseAbs().maxCoeff(),
              1e-9 * y[middle]);
  }
}

// Nor does it matter later that a signal stood somewhere else before.
TEST(LowPassMemory, IsWhenAStepIsForgotten) {
  const double rate = 1000, cutoff = 5;
  const int n = 12000, at = 6000;
  VectorXd x = VectorXd::Zero(n);
  x.tail(n - at).setOnes();
  const VectorXd y = ZeroPhaseLowPass(x, rate, cutoff);
  const int memory = static_cast<int>(std::ceil(LowPassMemory(cutoff) * rate));
  EXPECT_NEAR((y[at - 1] + y[at]) / 2, .5, 1e-9);
  EXPECT_LT(y.head(at - memory).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((y.tail(n - at - memory).array() - 1).abs().maxCoeff(), 1e-9);
}

// Whether signals are filtered or, at their rate, passed as they are.
TEST(ThinnedLowPass, IsRowsOfTheWhole) {
  constexpr int kSignals = 11, kFirst = 7, kStride = 9, kCount = 30;
  const MatrixXd x = MatrixXd::NullaryExpr(300, kSignals, [](int k, int c) {
    return std::sin(.1 * k * (c + 1)) + c;
  });
  std::vector<VectorXd> columns;
  for (int c = 0; c < kSignals; ++c) columns.push_back(x.col(c));
  std::vector<const VectorXd*> all;
  for (const VectorXd& column : columns) all.push_back(&column);
  for (const double cutoff : {4., 60.}) {
    const MatrixXd whole = ZeroPhaseLowPass(x, 100, cutoff);
    const MatrixXd thin =
        ThinnedLowPass(all, 100, cutoff, kFirst, kStride, kCount);
    for (int k = 0; k < kCount; ++k) {
      EXPECT_EQ(thin.row(k), whole.row(kFirst + k * kStride)) << cutoff;
    }
  }
  EXPECT_EQ(ThinnedLowPass({}, 100, 4, 0, 1, 3).cols(), 0);
}

TEST(Differentiate, IsExactOnPolynomials) {
  const double dt = .01;
  const int n = 40;
  MatrixXd x(n, 2), expected(n, 2);
  for (int k = 0; k < n; ++k) {
    const double t = k * dt;
    x.row(k) << 1 - 2 * t + 3 * t * t * t - 5 * t * t * t * t,
        4 - t + 6 * t * t;
    expected.row(k) << -2 + 9 * t * t - 20 * t * t * t, -1 + 12 * t;
  }
  const MatrixXd error = Differentiate(x, dt) - expected;
  EXPECT_LT(error.middleRows(2, n - 4).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(error.col(1).cwiseAbs().maxCoeff(), 1e-12);  // also at the ends
}

TEST(Differentiate, HasOrder4InsideAnd2AtTheEnds) {
  double inside[2], ends[2];
  for (const int fine : {0, 1}) {
    const int n = fine ? 401 : 201;
    const double dt = 2.0 / (n - 1);
    const VectorXd x =
        Samples(n, 1 / dt, [](double t) { return std::sin(3 * t); });
    const VectorXd d =
        Samples(n, 1 / dt, [](double t) { return 3 * std::cos(3 * t); });
    const VectorXd error = (Differentiate(x, dt) - d).cwiseAbs();
    inside[fine] = error.segment(2, n - 4).maxCoeff();
    ends[fine] = std::max(error[0], error[n - 1]);
  }
  EXPECT_NEAR(inside[0] / inside[1], 16, .3);
  EXPECT_NEAR(ends[0] / ends[1], 4, .5);
}

TEST(Differentiate, TakesShortStretches) {
  EXPECT_EQ(Differentiate(VectorXd::Ones(2), .1), VectorXd::Zero(2));
  EXPECT_EQ(Differentiate(MatrixXd(0, 2), .1).cols(), 2);
  const VectorXd x = Eigen::Vector4d(0, 1, 4, 9);  // k^2
  for (const int n : {3, 4}) {
    const VectorXd d = Differentiate(x.head(n), .5);
    for (int k = 0; k < n; ++k) EXPECT_NEAR(d[k], 4 * k, 1e-14) << n;
  }
}

}  // namespace armcal::low_pass_test
