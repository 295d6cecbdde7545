#pragma once

#include <Eigen/Core>
#include <deque>

namespace armcal {

// One row's part in an estimate x = gain * sum of C'(Y - U x): the score is
// C' r, r the residuals (n). C and U are n x size; 0 where an equation does not
// count.
struct Score {
  Eigen::VectorXd value;
  Eigen::MatrixXd C, U;
};

// The covariance of a sum of autocorrelated scores, in one pass: Newey-West
// with Bartlett weights 1 - |l| / window. It is accumulated as the mean square
// of sums over sliding windows, which is the same and positive semidefinite by
// construction. Windows do not reach across Break().
//
// The fit has taken its share of the residuals: a window's sum s is too small
// by M gain s, where M is the sum of its C'U. It is made (1 - M gain)^-1/2 s
// (to third order), as large as it is expected to be: Bell and McCaffrey's CR2
// (2002), for windows.
class ScoreCovariance {
 public:
  // gain: size x size; empty: nothing was fitted.
  ScoreCovariance(int size, int window, const Eigen::MatrixXd& gain = {});

  void Add(const Score& score);
  void Break();
  // The covariance of the sum of all scores added.
  Eigen::MatrixXd Value();

 private:
  void AccumulateWindow();
  Eigen::VectorXd TakenByFit(const Eigen::VectorXd& sum) const;

  int window_;
  Eigen::MatrixXd gain_;
  std::deque<Score> recent_;
  Eigen::VectorXd sum_;  // of recent_
  Eigen::MatrixXd squares_;
};

// Andrews' (1991) plug-in width of the Bartlett window for a series of `count`
// terms whose lag-one autocorrelation is rho; between `least` and a fifth of
// the series.
int BartlettWindow(double rho, long count, int least);

}  // namespace armcal
