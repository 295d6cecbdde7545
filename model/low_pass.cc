#include "model/low_pass.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kPi = 3.14159265358979323846;

// y_k = b (x_k + 2 x_{k-1} + x_{k-2}) - a1 y_{k-1} - a2 y_{k-2}
struct Section {
  double b, a1, a2;
};

// Order 4 as two second-order sections, by the bilinear transform with the
// cutoff prewarped.
std::array<Section, 2> Butterworth4(double sample_rate, double cutoff_hz) {
  const double w = std::tan(kPi * cutoff_hz / sample_rate);
  std::array<Section, 2> sections;
  for (int k = 0; k < 2; ++k) {
    // Pole pair at angle (2 k + 1) pi / 8 from the imaginary axis.
    const double damping = 2 * std::sin((2 * k + 1) * kPi / 8);
    const double scale = 1 / (1 + damping * w + w * w);
    sections[k] = {w * w * scale, 2 * (w * w - 1) * scale,
                   (1 - damping * w + w * w) * scale};
  }
  return sections;
}

// In place, from rest at the first value (the filter's gain at 0 Hz is 1).
void FilterForwards(const std::array<Section, 2>& sections, VectorXd* x) {
  const double rest = (*x)[0];
  for (const Section& s : sections) {
    double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
    for (double& value : *x) {
      const double x0 = value - rest;
      const double y0 = s.b * (x0 + 2 * x1 + x2) - s.a1 * y1 - s.a2 * y2;
      x2 = x1, x1 = x0, y2 = y1, y1 = y0;
      value = y0 + rest;
    }
  }
}

// Values beyond the end of x (its last element), nearest first.
VectorXd Reflected(const VectorXd& x, int count) {
  const Eigen::Index last = x.size() - 1;
  return VectorXd::NullaryExpr(count, [&](Eigen::Index k) {
    return 2 * x[last] - x[std::max<Eigen::Index>(0, last - 1 - k)];
  });
}

// Those of the cubic through the last `span` elements in the least-squares
// sense.
VectorXd Extrapolated(const VectorXd& x, int count, int span) {
  const auto powers = [span](int samples, double first) {
    const VectorXd s = VectorXd::LinSpaced(samples, first / span,
                                           (first + samples - 1) / span);
    MatrixXd A(samples, 4);
    A << VectorXd::Ones(samples), s, s.cwiseAbs2(), s.array().cube().matrix();
    return A;
  };
  const Eigen::Vector4d c =
      powers(span, -span).colPivHouseholderQr().solve(x.tail(span));
  return powers(count, 0) * c;
}

}  // namespace

MatrixXd ZeroPhaseLowPass(const MatrixXd& x, double sample_rate,
                          double cutoff_hz, Ends ends) {
  CHECK_GT(cutoff_hz, 0);
  const int n = static_cast<int>(x.rows());
  if (n < 2 || cutoff_hz >= 0.499 * sample_rate) return x;
  const auto sections = Butterworth4(sample_rate, cutoff_hz);
  // The filter starts from rest so far outside that polynomials pass.
  const int pad =
      static_cast<int>(std::ceil(sample_rate * LowPassMemory(cutoff_hz)));
  const int span = std::min(
      n, std::max(6, static_cast<int>(std::lround(sample_rate / cutoff_hz))));
  const bool extrapolate = ends == Ends::kExtrapolate && span >= 6;
  const auto beyond = [&](const VectorXd& end) -> VectorXd {
    return extrapolate ? Extrapolated(end, pad, span) : Reflected(end, pad);
  };
  MatrixXd result(n, x.cols());
  VectorXd padded(n + 2 * pad);
  for (int c = 0; c < x.cols(); ++c) {
    padded << beyond(x.col(c).reverse()).reverse(), x.col(c), beyond(x.col(c));
    FilterForwards(sections, &padded);
    padded.reverseInPlace();
    FilterForwards(sections, &padded);
    padded.reverseInPlace();
    result.col(c) = padded.segment(pad, n);
  }
  return result;
}

double LowPassMemory(double cutoff_hz) {
  // The slowest pole pair decays at sin(pi/8) times the cutoff; ln 1e9 = 20.7.
  return 20.7 / (std::sin(kPi / 8) * 2 * kPi * cutoff_hz);
}

MatrixXd Differentiate(const MatrixXd& x, double dt) {
  const int n = static_cast<int>(x.rows());
  MatrixXd d = MatrixXd::Zero(n, x.cols());
  if (n < 3) return d;
  for (int k = 0; k < n; ++k) {
    if (k >= 2 && k + 2 < n) {
      d.row(k) =
          (8 * (x.row(k + 1) - x.row(k - 1)) - (x.row(k + 2) - x.row(k - 2))) /
          (12 * dt);
    } else if (k >= 1 && k + 1 < n) {
      d.row(k) = (x.row(k + 1) - x.row(k - 1)) / (2 * dt);
    } else {
      const int s = k == 0 ? 1 : -1;
      d.row(k) =
          s * (-3 * x.row(k) + 4 * x.row(k + s) - x.row(k + 2 * s)) / (2 * dt);
    }
  }
  return d;
}

}  // namespace armcal
