#include "model/low_pass.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSideBySide = 6;  // columns filtered at once
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

// Two columns side by side in one register.
typedef double Pair __attribute__((vector_size(16)));

// A signal per lane, `pairs` pairs of them in each row. In place, from rest at
// the first row (the filter's gain at 0 Hz is 1); step -1: backwards.
template <int pairs>
void FilterRows(const std::array<Section, 2>& sections, Pair* x, long rows,
                int step) {
  Pair rest[pairs];
  for (size_t which = 0; which < sections.size(); ++which) {
    const Section s = sections[which];
    const Pair b = {s.b, s.b}, a1 = {s.a1, s.a1}, a2 = {s.a2, s.a2};
    Pair x1[pairs], x2[pairs], y1[pairs], y2[pairs];
    for (int p = 0; p < pairs; ++p) {
      if (which == 0) rest[p] = x[p];
      x1[p] = x2[p] = y1[p] = y2[p] = Pair{};
    }
    Pair* row = x;
    for (long k = 0; k < rows; ++k, row += step * pairs) {
#pragma GCC unroll 4
      for (int p = 0; p < pairs; ++p) {
        const Pair x0 = row[p] - rest[p];
        const Pair y0 = b * (x0 + 2 * x1[p] + x2[p]) - a1 * y1[p] - a2 * y2[p];
        x2[p] = x1[p], x1[p] = x0, y2[p] = y1[p], y1[p] = y0;
        row[p] = y0 + rest[p];
      }
    }
  }
}

// Forwards, then backwards.
template <int pairs>
void FilterBothWays(const std::array<Section, 2>& sections,
                    std::vector<Pair>* x) {
  const long rows = static_cast<long>(x->size()) / pairs;
  FilterRows<pairs>(sections, x->data(), rows, 1);
  FilterRows<pairs>(sections, x->data() + (rows - 1) * pairs, rows, -1);
}

// Values of a signal beyond its end, nearest first.
class Continuation {
 public:
  // `count` values; `cubic`: of the cubic through the last `span` elements in
  // the least-squares sense, else reflected.
  Continuation(bool cubic, int count, int span)
      : cubic_(cubic), count_(count), span_(span) {
    if (!cubic) return;
    inside_.compute(Powers(span, -span));
    beyond_ = Powers(count, 0);
  }

  // Beyond the last element of x.
  VectorXd operator()(const VectorXd& x) const {
    if (cubic_) {
      const Eigen::Vector4d c = inside_.solve(x.tail(span_));
      return beyond_ * c;
    }
    const Eigen::Index last = x.size() - 1;
    return VectorXd::NullaryExpr(count_, [&](Eigen::Index k) {
      return 2 * x[last] - x[std::max<Eigen::Index>(0, last - 1 - k)];
    });
  }

 private:
  MatrixXd Powers(int samples, double first) const {
    const VectorXd s = VectorXd::LinSpaced(samples, first / span_,
                                           (first + samples - 1) / span_);
    MatrixXd A(samples, 4);
    A << VectorXd::Ones(samples), s, s.cwiseAbs2(), s.array().cube().matrix();
    return A;
  }

  bool cubic_;
  int count_, span_;
  Eigen::ColPivHouseholderQR<MatrixXd> inside_;
  MatrixXd beyond_;
};

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
  const Continuation beyond(ends == Ends::kExtrapolate && span >= 6, pad, span);
  MatrixXd result(n, x.cols());
  for (int first = 0; first < x.cols(); first += kSideBySide) {
    const int columns =
        std::min(kSideBySide, static_cast<int>(x.cols()) - first);
    const int pairs = (columns + 1) / 2;
    std::vector<Pair> padded(static_cast<size_t>(n + 2 * pad) * pairs);
    double* const rows = reinterpret_cast<double*>(padded.data());
    for (int c = 0; c < columns; ++c) {
      double* to = rows + c;
      const auto put = [&](double value) {
        *to = value;
        to += 2 * pairs;
      };
      const VectorXd before = beyond(x.col(first + c).reverse());
      const VectorXd after = beyond(x.col(first + c));
      for (int k = pad - 1; k >= 0; --k) put(before[k]);
      for (const double value : x.col(first + c)) put(value);
      for (const double value : after) put(value);
    }
    if (pairs == 1) FilterBothWays<1>(sections, &padded);
    if (pairs == 2) FilterBothWays<2>(sections, &padded);
    if (pairs == 3) FilterBothWays<3>(sections, &padded);
    const double* const inner = rows + 2L * pairs * pad;
    for (int c = 0; c < columns; ++c) {
      for (long k = 0; k < n; ++k) {
        result(k, first + c) = inner[2 * pairs * k + c];
      }
    }
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
  for (int c = 0; c < x.cols(); ++c) {
    const double* const from = x.col(c).data();
    double* const to = d.col(c).data();
    to[0] = (-3 * from[0] + 4 * from[1] - from[2]) / (2 * dt);
    to[1] = (from[2] - from[0]) / (2 * dt);
    for (int k = 2; k + 2 < n; ++k) {
      to[k] = (8 * (from[k + 1] - from[k - 1]) - (from[k + 2] - from[k - 2])) /
              (12 * dt);
    }
    to[n - 2] = (from[n - 1] - from[n - 3]) / (2 * dt);
    to[n - 1] =
        -1 * (-3 * from[n - 1] + 4 * from[n - 2] - from[n - 3]) / (2 * dt);
  }
  return d;
}

}  // namespace armcal
