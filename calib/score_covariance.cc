#include "calib/score_covariance.h"

#include <algorithm>
#include <cmath>

namespace armcal {

ScoreCovariance::ScoreCovariance(int size, int window)
    : window_(std::max(1, window)),
      sum_(Eigen::VectorXd::Zero(size)),
      squares_(Eigen::MatrixXd::Zero(size, size)) {}

void ScoreCovariance::AccumulateWindow() {
  squares_.selfadjointView<Eigen::Lower>().rankUpdate(sum_);
}

void ScoreCovariance::Add(const Eigen::VectorXd& score) {
  if (static_cast<int>(recent_.size()) == window_) {
    sum_ -= recent_.front();
    recent_.pop_front();
  }
  recent_.push_back(score);
  sum_ += score;
  AccumulateWindow();
}

void ScoreCovariance::Break() {
  // A series shorter than the window lies in so many windows as a whole.
  const int room = window_ - static_cast<int>(recent_.size());
  for (int k = 0; k < room && !recent_.empty(); ++k) AccumulateWindow();
  while (recent_.size() > 1) {
    sum_ -= recent_.front();
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
