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
// (2002), for windows. Where that is done, at three products for
// each window, windows are an eighth of their length apart: of white scores the
// estimate then has 2/3 + 1/(3 8^2) of the variance that windows side by side
// would give it, .8 % above the least that overlap can reach.
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
  void VisitWindow();
  void Put(const Score& score);
  void DropOldest();
  Eigen::VectorXd TakenByFit(const Eigen::VectorXd& sum) const;

  static constexpr int kNumOffsets = 8;

  int window_;
  int stride_ = 1;                      // between windows that are accumulated
  int until_ = 1;                       // the next one
  std::deque<Eigen::VectorXd> recent_;  // values
  Eigen::VectorXd sum_;                 // of recent_
  Eigen::MatrixXd squares_;
  // Where a gain is given, C and U of recent_, for products of many rows at a
  // time: rows are rounded up to whole registers, and 0 where there is nothing.
  // The oldest of window_ places is the next to be taken.
  Eigen::MatrixXd gain_;  // a row of the gain in each column
  Eigen::MatrixXd U_;     // an equation in each column
  Eigen::MatrixXd C_;     // an equation in each row
  int oldest_ = 0;        // place
};

// Andrews' (1991) plug-in width of the Bartlett window for a series of `count`
// terms whose lag-one autocorrelation is rho; between `least` and a fifth of
// the series.
int BartlettWindow(double rho, long count, int least);

// By how much a variance from windows of this length has to be larger for
// intervals of 1.96 deviations to hold what they should: a long-run variance is
// itself uncertain where windows are a share b of the series, as Student's t
// says of few samples. The critical value of Bartlett windows at 95 % is
//   1.96 + 2.9694 b + .4160 b^2 - .5324 b^3
// (Kiefer and Vogelsang 2005, Econometric Theory 21, table 1).
double FixedShareExpansion(int window, long count);

}  // namespace armcal
