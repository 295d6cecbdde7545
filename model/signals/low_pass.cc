#include "model/signals/low_pass.h"

#include <glog/logging.h>

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>

#include "model/simd/kernels.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kSideBySide = 8;  // signals in a row of numbers, a cache line
constexpr double kPi = 3.14159265358979323846;

using simd::FilterSection;

// Order 4 as two second-order sections, by the bilinear transform with the
// cutoff prewarped.
std::array<FilterSection, 2> Butterworth4(double sample_rate,
                                          double cutoff_hz) {
  const double w = std::tan(kPi * cutoff_hz / sample_rate);
  std::array<FilterSection, 2> sections;
  for (int k = 0; k < 2; ++k) {
    // Pole pair at angle (2 k + 1) pi / 8 from the imaginary axis.
    const double damping = 2 * std::sin((2 * k + 1) * kPi / 8);
    const double scale = 1 / (1 + damping * w + w * w);
    sections[k] = {w * w * scale, 2 * (w * w - 1) * scale,
                   (1 - damping * w + w * w) * scale};
  }
  return sections;
}

// Rows of signals side by side, on borders of cache lines.
class SignalRows {
 public:
  explicit SignalRows(long rows)
      : rows_(rows),
        x_(static_cast<double*>(::operator new(
            sizeof(double[kSideBySide]) * rows, std::align_val_t(64)))) {}

  Eigen::Map<
      Eigen::Matrix<double, Eigen::Dynamic, kSideBySide, Eigen::RowMajor>>
  matrix() {
    return {x_.get(), rows_, kSideBySide};
  }
  void Filter(const std::array<FilterSection, 2>& sections) {
    simd::BestKernels().filter_both_ways(sections.data(), x_.get(), rows_,
                                         kSideBySide);
  }

 private:
  struct Free {
    void operator()(double* x) const {
      ::operator delete(x, std::align_val_t(64));
    }
  };
  long rows_;
  std::unique_ptr<double[], Free> x_;
};

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

  // How many elements before the end it depends on.
  int reach() const { return cubic_ ? span_ : count_ + 1; }
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

// A low pass of signals of n samples, kSideBySide of them at a time.
class LowPass {
 public:
  LowPass(int n, double sample_rate, double cutoff_hz, Ends ends)
      : n_(n),
        // The filter starts from rest so far outside that polynomials pass.
        pad_(static_cast<int>(
            std::ceil(sample_rate * LowPassMemory(cutoff_hz)))),
        span_(std::min(n, std::max(6, static_cast<int>(std::lround(
                                          sample_rate / cutoff_hz))))),
        sections_(Butterworth4(sample_rate, cutoff_hz)),
        beyond_(ends == Ends::kExtrapolate && span_ >= 6, pad_, span_),
        rows_(n + 2L * pad_) {}

  // Whether there is something to filter. The filter's memory of what is far
  // shorter would not fit into ours.
  static bool Filters(int n, double sample_rate, double cutoff_hz) {
    return n >= 2 && cutoff_hz < 0.499 * sample_rate &&
           100 * n >= sample_rate / cutoff_hz;
  }

  // The c-th of at most kSideBySide signals, before they are filtered.
  template <typename Signal>
  void Take(int c, const Signal& signal) {
    const int reach = std::min(n_, beyond_.reach());
    auto all = rows_.matrix();
    all.col(c).segment(pad_, n_) = signal;
    all.col(c).head(pad_) = beyond_(signal.head(reach).reverse()).reverse();
    all.col(c).tail(pad_) = beyond_(signal.tail(reach));
  }
  // The first `columns`, filtered.
  auto Filtered(int columns) {
    rows_.matrix().rightCols(kSideBySide - columns).setZero();
    rows_.Filter(sections_);
    return rows_.matrix().block(pad_, 0, n_, columns);
  }

 private:
  int n_, pad_, span_;
  std::array<FilterSection, 2> sections_;
  Continuation beyond_;
  SignalRows rows_;
};

}  // namespace

MatrixXd ZeroPhaseLowPass(const MatrixXd& x, double sample_rate,
                          double cutoff_hz, Ends ends) {
  CHECK_GT(cutoff_hz, 0);
  const int n = static_cast<int>(x.rows());
  if (!LowPass::Filters(n, sample_rate, cutoff_hz)) return x;
  LowPass filter(n, sample_rate, cutoff_hz, ends);
  MatrixXd result(n, x.cols());
  for (int first = 0; first < x.cols(); first += kSideBySide) {
    const int columns =
        std::min(kSideBySide, static_cast<int>(x.cols()) - first);
    for (int c = 0; c < columns; ++c) filter.Take(c, x.col(first + c));
    result.middleCols(first, columns) = filter.Filtered(columns);
  }
  return result;
}

MatrixXd ThinnedLowPass(const std::vector<const VectorXd*>& x,
                        double sample_rate, double cutoff_hz, int first,
                        int stride, int count) {
  CHECK_GT(cutoff_hz, 0);
  MatrixXd result(count, x.size());
  if (x.empty()) return result;
  const Eigen::VectorXi rows = Eigen::VectorXi::NullaryExpr(
      count,
      [=](Eigen::Index k) { return first + stride * static_cast<int>(k); });
  const int n = static_cast<int>(x[0]->size());
  if (!LowPass::Filters(n, sample_rate, cutoff_hz)) {
    for (size_t c = 0; c < x.size(); ++c) result.col(c) = (*x[c])(rows);
    return result;
  }
  LowPass filter(n, sample_rate, cutoff_hz, Ends::kReflect);
  for (size_t begin = 0; begin < x.size(); begin += kSideBySide) {
    const int columns =
        static_cast<int>(std::min<size_t>(kSideBySide, x.size() - begin));
    for (int c = 0; c < columns; ++c) filter.Take(c, *x[begin + c]);
    result.middleCols(begin, columns) =
        filter.Filtered(columns)(rows, Eigen::all);
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
