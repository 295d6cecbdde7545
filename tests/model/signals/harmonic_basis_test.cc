#include "model/signals/harmonic_basis.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

namespace armcal::harmonic_basis_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(HarmonicBasis, RestsWhereAPeriodBegins) {
  const HarmonicBasis basis(7, 5);
  EXPECT_EQ(basis.size(), 9);
  const Motion ends = basis.Units(3, 7);
  EXPECT_LT(ends.qd.cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(ends.qdd.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((ends.q.row(0) - ends.q.row(2)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(HarmonicBasis, RatesAreDerivatives) {
  const HarmonicBasis basis(3, 4);
  constexpr double h = 1e-5;
  const Motion at = basis.Units(3 / h, h);
  for (const int k : {100, 130000, 290000}) {
    EXPECT_LT(
        (at.qd.row(k) - (at.q.row(k + 1) - at.q.row(k - 1)) / (2 * h)).norm(),
        1e-7);
    EXPECT_LT((at.qdd.row(k) - (at.qd.row(k + 1) - at.qd.row(k - 1)) / (2 * h))
                  .norm(),
              1e-7);
  }
}

// All that is periodic with these harmonics and rests there: the columns are
// independent, and 2 K + 1 numbers less two are left.
TEST(HarmonicBasis, LosesNothing) {
  const HarmonicBasis basis(2, 6);
  const Motion at = basis.Units(200, .01);
  EXPECT_EQ(at.q.colPivHouseholderQr().rank(), 11);
  // sin(w t) - sin(2 w t) / 2 starts at rest.
  const Eigen::ArrayXd phase =
      M_PI * .01 * VectorXd::LinSpaced(200, 0, 199).array();
  const VectorXd wave = phase.sin() - (2 * phase).sin() / 2;
  const VectorXd c = at.q.colPivHouseholderQr().solve(wave);
  EXPECT_LT((at.q * c - wave).norm(), 1e-12);
}

TEST(HarmonicBasis, FourierCoefficientsAreTheMotion) {
  const HarmonicBasis basis(4, 3);
  const MatrixXd numbers = MatrixXd::Random(basis.size(), 2);
  const Motion motion = Combine(basis.Units(9, .3), numbers);
  const FourierCoefficients fourier = basis.Fourier(numbers);
  for (int s = 0; s < 9; ++s) {
    VectorXd q = fourier.constant;
    for (int k = 0; k < 3; ++k) {
      const double phase = 2 * M_PI * (k + 1) * .3 * s / 4;
      q += fourier.sine.row(k).transpose() * std::sin(phase) +
           fourier.cosine.row(k).transpose() * std::cos(phase);
    }
    EXPECT_LT((q - motion.q.row(s).transpose()).norm(), 1e-13);
  }
}

}  // namespace armcal::harmonic_basis_test
