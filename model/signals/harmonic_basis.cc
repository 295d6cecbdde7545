#include "model/signals/harmonic_basis.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <cmath>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Sine k has the velocity cos, which is 1 at the beginning, and cosine k the
// acceleration -k w cos: what is free adds up to 0 in both.
HarmonicBasis::HarmonicBasis(double period, int harmonics)
    : period_(period), harmonics_(harmonics) {
  CHECK(period > 0 && harmonics >= 2);
  const int K = harmonics;
  MatrixXd held = MatrixXd::Zero(2 * K, 2);
  for (int k = 0; k < K; ++k) {
    held(k, 0) = 1;
    held(K + k, 1) = k + 1;
  }
  const MatrixXd Q = held.householderQr().householderQ();
  free_ = Q.rightCols(2 * K - 2);
}

Motion HarmonicBasis::Units(int samples, double dt) const {
  const int K = harmonics_;
  MatrixXd q(samples, 2 * K), qd(samples, 2 * K), qdd(samples, 2 * K);
  const Eigen::ArrayXd t =
      dt * Eigen::ArrayXd::LinSpaced(samples, 0, samples - 1);
  for (int k = 0; k < K; ++k) {
    const double w = 2 * M_PI * (k + 1) / period_;
    const Eigen::ArrayXd sine = (w * t).sin(), cosine = (w * t).cos();
    q.col(k) = sine / w;
    qd.col(k) = cosine;
    qdd.col(k) = -w * sine;
    q.col(K + k) = cosine / w;
    qd.col(K + k) = -sine;
    qdd.col(K + k) = -w * cosine;
  }
  Motion units;
  units.dt = dt;
  const auto with_constant = [&](double constant, const MatrixXd& waves) {
    MatrixXd all(samples, size());
    all << VectorXd::Constant(samples, constant), waves * free_;
    return all;
  };
  units.q = with_constant(1, q);
  units.qd = with_constant(0, qd);
  units.qdd = with_constant(0, qdd);
  return units;
}

FourierCoefficients HarmonicBasis::Fourier(const MatrixXd& numbers) const {
  const int K = harmonics_;
  MatrixXd waves = free_ * numbers.bottomRows(size() - 1);
  for (int k = 0; k < K; ++k) {
    const double w = 2 * M_PI * (k + 1) / period_;
    waves.row(k) /= w;
    waves.row(K + k) /= w;
  }
  return {numbers.row(0), waves.topRows(K), waves.bottomRows(K)};
}

Motion Combine(const Motion& units, const MatrixXd& numbers) {
  Motion motion;
  motion.t0 = units.t0;
  motion.dt = units.dt;
  motion.q = units.q * numbers;
  motion.qd = units.qd * numbers;
  motion.qdd = units.qdd * numbers;
  return motion;
}

}  // namespace armcal
