#include "model/signals/delayed_signal.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

constexpr int kPoints = 6;
constexpr int kBefore = kPoints / 2 - 1;  // of them, before those at both sides

// Lagrange's weights of samples -kBefore to kBefore + 1 at `share`, 0 to 1.
std::array<double, kPoints> LagrangeWeights(double share) {
  std::array<double, kPoints> weights;
  for (int i = 0; i < kPoints; ++i) {
    weights[i] = 1;
    for (int k = 0; k < kPoints; ++k) {
      if (k != i) weights[i] *= (share - (k - kBefore)) / (i - k);
    }
  }
  return weights;
}

// The straight line that is closest to some rows, from the first on.
struct Line {
  explicit Line(const MatrixXd& rows) : mean(rows.colwise().mean()) {
    middle = .5 * static_cast<double>(rows.rows() - 1);
    slope = RowVectorXd::Zero(rows.cols());
    double squares = 0;
    for (Index k = 0; k < rows.rows(); ++k) {
      const double from_middle = static_cast<double>(k) - middle;
      slope += from_middle * rows.row(k);
      squares += from_middle * from_middle;
    }
    if (squares > 0) slope /= squares;
  }
  RowVectorXd At(double k) const { return mean + (k - middle) * slope; }

  double middle;
  RowVectorXd mean, slope;
};

}  // namespace

MatrixXd Delayed(const MatrixXd& signal, double delay) {
  MatrixXd delayed(signal.rows(), signal.cols());
  const Index last = signal.rows() - 1;
  const Index ends = std::min<Index>(
      signal.rows(),
      std::max<Index>(kPoints, static_cast<Index>(std::abs(delay))));
  const Line begin(signal.topRows(ends)), end(signal.bottomRows(ends));
  const auto weights = LagrangeWeights(-delay - std::floor(-delay));
  for (Index k = 0; k <= last; ++k) {
    const double at = static_cast<double>(k) - delay;
    const auto before = static_cast<Index>(std::floor(at));
    const Index first = before - kBefore;
    if (at < 0) {
      delayed.row(k) = begin.At(at);
    } else if (at > static_cast<double>(last)) {
      delayed.row(k) = end.At(at - static_cast<double>(last + 1 - ends));
    } else if (first < 0 || first + kPoints > last + 1) {
      const double share = at - static_cast<double>(before);
      delayed.row(k) = (1 - share) * signal.row(before) +
                       share * signal.row(std::min(before + 1, last));
    } else {
      delayed.row(k).setZero();
      for (int i = 0; i < kPoints; ++i) {
        delayed.row(k) += weights[i] * signal.row(first + i);
      }
    }
  }
  return delayed;
}

}  // namespace armcal
