#include "calib/numerics/autoregression.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>

#include "calib/numerics/median.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kWindow = 64;         // samples
constexpr int kNeighbours = 5;      // frequencies of a running median
constexpr double kLeastOfAll = 40;  // samples

// The mean of what Median() takes of `count` exponential variables, per their
// mean: of an order statistic (Allen et al. 2012, appendix B, for odd counts).
double MedianBias(int count) {
  double bias = 0;
  for (int k = count - count / 2; k <= count; ++k) bias += 1.0 / k;
  return bias;
}

// |sum x e^-iwt|^2 at frequencies 0 .. size / 2 of a tapered window.
VectorXd Periodogram(const VectorXd& x) {
  const int size = static_cast<int>(x.size());
  VectorXd power(size / 2 + 1);
  double taper_power = 0;
  VectorXd tapered(size);
  for (int k = 0; k < size; ++k) {
    const double taper = .5 - .5 * std::cos(2 * M_PI * (k + .5) / size);
    tapered[k] = taper * x[k];
    taper_power += taper * taper;
  }
  for (int f = 0; f < power.size(); ++f) {
    const std::complex<double> turn = std::polar(1.0, -2 * M_PI * f / size);
    std::complex<double> sum = 0, phase = 1;
    for (int k = 0; k < size; ++k, phase *= turn) sum += tapered[k] * phase;
    power[f] = std::norm(sum) / taper_power;
  }
  return power;
}

VectorXd MedianSpectrum(const std::vector<VectorXd>& stretches, int window,
                        bool remove_mean) {
  std::vector<VectorXd> periodograms;
  for (const VectorXd& x : stretches) {
    const double mean = remove_mean ? x.mean() : 0;
    for (int begin = 0; begin + window <= x.size(); begin += window / 2) {
      periodograms.push_back(
          Periodogram((x.segment(begin, window).array() - mean).matrix()));
    }
  }
  VectorXd spectrum(window / 2 + 1);
  for (int f = 0; f < spectrum.size(); ++f) {
    std::vector<double> values;
    for (const VectorXd& power : periodograms) values.push_back(power[f]);
    spectrum[f] =
        Median(values) / MedianBias(static_cast<int>(periodograms.size()));
  }
  VectorXd smooth(spectrum.size());
  const int last = static_cast<int>(spectrum.size()) - 1;
  for (int f = 0; f <= last; ++f) {
    std::vector<double> near;
    for (int k = f - kNeighbours / 2; k <= f + kNeighbours / 2; ++k) {
      near.push_back(spectrum[std::clamp(k, 1, last)]);
    }
    smooth[f] = Median(near);
  }
  return smooth;
}

Autoregression FromCovariance(const VectorXd& r) {
  constexpr int p = Autoregression::kOrder;
  Autoregression noise;
  Eigen::Matrix<double, p, p> R;
  for (int i = 0; i < p; ++i) {
    for (int j = 0; j < p; ++j) R(i, j) = r[std::abs(i - j)];
  }
  R.diagonal().array() += 1e-6 * r[0];
  noise.a = R.ldlt().solve(r.segment<p>(1));
  noise.sigma =
      std::sqrt(std::max(r[0] - noise.a.dot(r.segment<p>(1)), 1e-9 * r[0]));
  return noise;
}

// What one e_t of 1 makes of x.
VectorXd ImpulseResponse(const Autoregression& noise) {
  constexpr int kLength = 4000, kOrder = Autoregression::kOrder;
  VectorXd h = VectorXd::Zero(kLength + kOrder);
  h[kOrder] = 1;
  for (int k = kOrder + 1; k < h.size(); ++k) {
    for (int i = 1; i <= kOrder; ++i) h[k] += noise.a[i - 1] * h[k - i];
  }
  return h;
}

}  // namespace

MatrixXd Autoregression::Whiten(const MatrixXd& x) const {
  const Eigen::Index rows = x.rows() - kOrder;
  MatrixXd white = x.bottomRows(rows);
  for (int k = 1; k <= kOrder; ++k) {
    white -= a[k - 1] * x.middleRows(kOrder - k, rows);
  }
  return white / sigma;
}

double Autoregression::stddev() const {
  // The impulse response's energy is the variance per unit of sigma^2.
  return sigma * ImpulseResponse(*this).norm();
}

Autoregression PlusWhite(const Autoregression& noise, double stddev) {
  const VectorXd h = ImpulseResponse(noise);
  VectorXd r(Autoregression::kOrder + 1);
  for (int lag = 0; lag < r.size(); ++lag) {
    const Eigen::Index overlap = h.size() - lag;
    r[lag] = noise.sigma * noise.sigma * h.head(overlap).dot(h.tail(overlap));
  }
  r[0] += stddev * stddev;
  return r[0] > 0 ? FromCovariance(r) : noise;
}

Autoregression FitAutoregression(const std::vector<VectorXd>& stretches,
                                 bool remove_mean) {
  int longest = 0;
  double samples = 0, power = 0;
  for (const VectorXd& x : stretches) {
    longest = std::max(longest, static_cast<int>(x.size()));
    samples += x.size();
    power += (x.array() - (remove_mean ? x.mean() : 0)).square().sum();
  }
  Autoregression noise;
  if (samples < kLeastOfAll || longest < kWindow / 2) {
    if (samples > 1 && power > 0) noise.sigma = std::sqrt(power / samples);
    return noise;
  }
  const int window = std::min(kWindow, longest / 2 * 2);
  const VectorXd spectrum = MedianSpectrum(stretches, window, remove_mean);
  VectorXd r(Autoregression::kOrder + 1);
  const int last = static_cast<int>(spectrum.size()) - 1;
  for (int lag = 0; lag < r.size(); ++lag) {
    r[lag] = spectrum[0] + (lag % 2 ? -1 : 1) * spectrum[last];
    for (int f = 1; f < last; ++f) {
      r[lag] += 2 * spectrum[f] * std::cos(M_PI * f * lag / last);
    }
    r[lag] /= 2 * last;
  }
  if (!(r[0] > 0)) return noise;
  return FromCovariance(r);
}

Autoregression FitYuleWalker(const std::vector<VectorXd>& stretches) {
  VectorXd r = VectorXd::Zero(Autoregression::kOrder + 1);
  double samples = 0;
  for (const VectorXd& x : stretches) {
    samples += x.size();
    for (Eigen::Index lag = 0; lag < std::min(r.size(), x.size()); ++lag) {
      const Eigen::Index overlap = x.size() - lag;
      r[lag] += x.head(overlap).dot(x.tail(overlap));
    }
  }
  return r[0] > 0 ? FromCovariance(r / samples) : Autoregression();
}

double IndependentSamples(const VectorXd& x) {
  const Eigen::Index n = x.size();
  const double r = std::clamp(
      x.head(n - 1).dot(x.tail(n - 1)) / (x.squaredNorm() + 1e-300), 0., .99);
  return static_cast<double>(n) * (1 - r) / (1 + r);
}

std::vector<Autoregression> WhiteNoise(const MatrixXd& x) {
  constexpr double kLeast = 1e-12;  // where there is none
  std::vector<Autoregression> noise(x.cols());
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    noise[j].sigma = std::max(x.col(j).norm() / std::sqrt(x.rows()), kLeast);
  }
  return noise;
}

}  // namespace armcal
