#include "calib/score_covariance.h"

#include <algorithm>
#include <cmath>

namespace armcal {

ScoreCovariance::ScoreCovariance(int size, int window,
                                 const Eigen::MatrixXd& gain)
    : window_(std::max(1, window)),
      gain_(gain),
      sum_(Eigen::VectorXd::Zero(size)),
      squares_(Eigen::MatrixXd::Zero(size, size)) {}

// M gain s of the window.
Eigen::VectorXd ScoreCovariance::TakenByFit(const Eigen::VectorXd& sum) const {
  const Eigen::VectorXd x = gain_ * sum;
  Eigen::VectorXd taken = Eigen::VectorXd::Zero(sum.size());
  for (const Score& score : recent_) {
    taken.noalias() += score.C.transpose() * (score.U * x);
  }
  return taken;
}

void ScoreCovariance::AccumulateWindow() {
  Eigen::VectorXd sum = sum_;
  if (gain_.size() > 0) {
    Eigen::VectorXd power = sum_;
    for (const double coefficient : {1.0 / 2, 3.0 / 8, 5.0 / 16}) {
      power = TakenByFit(power);
      sum += coefficient * power;
    }
  }
  squares_.selfadjointView<Eigen::Lower>().rankUpdate(sum);
}

void ScoreCovariance::Add(const Score& score) {
  if (static_cast<int>(recent_.size()) == window_) {
    sum_ -= recent_.front().value;
    recent_.pop_front();
  }
  recent_.push_back(score);
  sum_ += score.value;
  AccumulateWindow();
}

void ScoreCovariance::Break() {
  // A series shorter than the window lies in so many windows as a whole.
  const int room = window_ - static_cast<int>(recent_.size());
  for (int k = 0; k < room && !recent_.empty(); ++k) AccumulateWindow();
  while (recent_.size() > 1) {
    sum_ -= recent_.front().value;
    recent_.pop_front();
    AccumulateWindow();
  }
  recent_.clear();
  sum_.setZero();
}

Eigen::MatrixXd ScoreCovariance::Value() {
  Break();
  Eigen::MatrixXd full = squares_.selfadjointView<Eigen::Lower>();
  return full / window_;
}

int BartlettWindow(double rho, long count, int least) {
  const double r = std::clamp(rho, 0.0, 0.97);
  const double alpha = 4 * r * r / (std::pow(1 - r, 2) * std::pow(1 + r, 2));
  const double width = 1.1447 * std::cbrt(alpha * static_cast<double>(count));
  const int most = std::max(1, static_cast<int>(count / 5));
  return std::min(most,
                  std::max(least, static_cast<int>(std::ceil(width)) + 1));
}

}  // namespace armcal
