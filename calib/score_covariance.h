#pragma once

#include <Eigen/Core>
#include <deque>

namespace armcal {

// The covariance of a sum of autocorrelated scores, in one pass: Newey-West
// with Bartlett weights 1 - |l| / window. It is accumulated as the mean square
// of sums over sliding windows, which is the same and positive semidefinite by
// construction. Windows do not reach across Break().
class ScoreCovariance {
 public:
  ScoreCovariance(int size, int window);

  void Add(const Eigen::VectorXd& score);
  void Break();
  // The covariance of the sum of all scores added.
  Eigen::MatrixXd Value();

 private:
  void AccumulateWindow();

  int window_;
  std::deque<Eigen::VectorXd> recent_;
  Eigen::VectorXd sum_;  // of recent_
  Eigen::MatrixXd squares_;
};

// Andrews' (1991) plug-in width of the Bartlett window for a series of `count`
// terms whose lag-one autocorrelation is rho; between `least` and a fifth of
// the series.
int BartlettWindow(double rho, long count, int least);

}  // namespace armcal
