#include "calib/numerics/power_spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

VectorXd HannWindow(int size) {
  const VectorXd phase =
      VectorXd::LinSpaced(size, 0, size - 1) * (2 * M_PI / size);
  return (1 - phase.array().cos()) / 2;
}

}  // namespace

PowerSpectrum::PowerSpectrum(int num_signals, double dt, int window)
    : dt_(dt),
      window_(window),
      hann_(HannWindow(window)),
      recent_(window, num_signals),
      sums_(MatrixXd::Zero(window / 2 + 1, num_signals)) {}

void PowerSpectrum::Add(const VectorXd& values) {
  recent_.row(filled_++) = values.transpose();
  if (filled_ < window_) return;
  AddWindow();
  const int half = window_ / 2;
  recent_.topRows(window_ - half) = recent_.bottomRows(window_ - half).eval();
  filled_ = window_ - half;
}

void PowerSpectrum::Break() { filled_ = 0; }

void PowerSpectrum::AddWindow() {
  Eigen::FFT<double> fft;
  Eigen::VectorXcd transform;
  const double power = hann_.squaredNorm();
  for (Eigen::Index j = 0; j < recent_.cols(); ++j) {
    const VectorXd x =
        (recent_.col(j).array() - recent_.col(j).mean()) * hann_.array();
    fft.fwd(transform, x);
    for (Eigen::Index k = 0; k < sums_.rows(); ++k) {
      const bool twice = k > 0 && 2 * k < window_;
      sums_(k, j) += (twice ? 2 : 1) * std::norm(transform[k]) * dt_ / power;
    }
  }
  ++windows_;
}

VectorXd PowerSpectrum::Frequencies() const {
  return VectorXd::LinSpaced(sums_.rows(), 0,
                             static_cast<double>(sums_.rows() - 1)) /
         (window_ * dt_);
}

MatrixXd PowerSpectrum::Density() const {
  return sums_ / std::max(1L, windows_);
}

}  // namespace armcal
