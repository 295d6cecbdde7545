#include "calib/linear/score_covariance.h"

#include <algorithm>
#include <cmath>

#include "model/simd/kernels.h"

namespace armcal {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index Whole(Index rows) { return (rows + 7) / 8 * 8; }

// Sets A' x; both have rows to fill registers.
void Multiply(const MatrixXd& A, const VectorXd& x, VectorXd* products) {
  simd::BestKernels().inner_products(A.data(), A.rows(),
                                     static_cast<int>(A.cols()), x.data(),
                                     x.size(), 1, A.rows(), products->data());
}

}  // namespace

ScoreCovariance::ScoreCovariance(int size, int window, const MatrixXd& gain)
    : window_(std::max(1, window)),
      sum_(VectorXd::Zero(size)),
      squares_(MatrixXd::Zero(size, size)) {
  if (gain.size() == 0) return;
  stride_ = std::max(1, window_ / kNumOffsets);
  gain_ = MatrixXd::Zero(Whole(size), size);
  gain_.topRows(size) = gain.transpose();
}

// M G s of the window, with M = sum of its C'U, as C'(U (G s)): three products
// with vectors instead of M, which would cost a product of matrices for each
// window.
VectorXd ScoreCovariance::TakenByFit(const VectorXd& sum) const {
  VectorXd s = VectorXd::Zero(gain_.rows()), x = s;
  s.head(sum.size()) = sum;
  Multiply(gain_, s, &x);
  VectorXd fitted = VectorXd::Zero(C_.rows()), taken(sum.size());
  Multiply(U_, x, &fitted);
  Multiply(C_, fitted, &taken);
  return taken;
}

// Adds s s' of one window, with s corrected by (1 - x)^-1/2 = 1 + x/2 + 3/8 x^2
// + 5/16 x^3 + .., x = M G (the header's CR2). Mean squares of sliding sums
// over `window` terms have lag l in window - |l| of them: Bartlett's weights
// (Newey & West 1987).
void ScoreCovariance::AccumulateWindow() {
  VectorXd sum = sum_;
  if (gain_.size() > 0) {
    VectorXd power = sum_;
    for (const double coefficient : {1.0 / 2, 3.0 / 8, 5.0 / 16}) {
      power = TakenByFit(power);
      sum += coefficient * power;
    }
  }
  squares_.noalias() += sum * sum.transpose();
}

// A product of scores a lag l apart lies in window - l windows, of which every
// stride-th counts stride times.
void ScoreCovariance::VisitWindow() {
  if (--until_ > 0) return;
  until_ = stride_;
  AccumulateWindow();
}

// Puts the score's equations behind those of the others.
void ScoreCovariance::Put(const Score& score) {
  const Index n = score.C.rows(), size = sum_.size();
  if (C_.size() == 0) {
    C_ = MatrixXd::Zero(Whole(window_ * n), size);
    U_ = MatrixXd::Zero(gain_.rows(), window_ * n);
  }
  const int place = (oldest_ + static_cast<int>(recent_.size())) % window_;
  C_.middleRows(place * n, n) = score.C;
  U_.middleCols(place * n, n).topRows(size) = score.U.transpose();
}

void ScoreCovariance::DropOldest() {
  sum_ -= recent_.front();
  recent_.pop_front();
  if (gain_.size() > 0) {
    const Index n = U_.cols() / window_;
    C_.middleRows(oldest_ * n, n).setZero();
  }
  oldest_ = oldest_ + 1 < window_ ? oldest_ + 1 : 0;
}

void ScoreCovariance::Add(const Score& score) {
  if (static_cast<int>(recent_.size()) == window_) DropOldest();
  if (gain_.size() > 0) Put(score);
  recent_.push_back(score.value);
  sum_ += score.value;
  VisitWindow();
}

// Ends a series. Sums over its beginning and end, shorter than the window,
// count as well, so that every product of scores has the weight that its lag
// gives it.
void ScoreCovariance::Break() {
  // A series shorter than the window lies in so many windows as a whole.
  const int room = window_ - static_cast<int>(recent_.size());
  for (int k = 0; k < room && !recent_.empty(); ++k) VisitWindow();
  while (!recent_.empty()) {
    DropOldest();
    if (!recent_.empty()) VisitWindow();
  }
  sum_.setZero();
}

MatrixXd ScoreCovariance::Value() {
  Break();
  return squares_ * stride_ / window_;
}

// Andrews (1991, Econometrica 59), section 6, for a first-order autoregression
// of coefficient rho:
//   window = 1.1447 (alpha count)^(1/3),
//   alpha = 4 rho^2 / ((1 - rho)^2 (1 + rho)^2).
// The bound on rho keeps a drift from asking for a window as long as the log.
int BartlettWindow(double rho, long count, int least) {
  const double r = std::clamp(rho, 0.0, 0.97);
  const double alpha = 4 * r * r / (std::pow(1 - r, 2) * std::pow(1 + r, 2));
  const double width = 1.1447 * std::cbrt(alpha * static_cast<double>(count));
  const int most = std::max(1, static_cast<int>(count / 5));
  return std::min(most,
                  std::max(least, static_cast<int>(std::ceil(width)) + 1));
}

double FixedShareExpansion(int window, long count) {
  const double b =
      std::min(1., static_cast<double>(window) / static_cast<double>(count));
  const double critical = 1.96 + 2.9694 * b + .4160 * b * b - .5324 * b * b * b;
  return std::pow(critical / 1.96, 2);
}

}  // namespace armcal
