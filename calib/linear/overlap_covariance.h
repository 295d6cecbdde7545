#pragma once

#include <Eigen/Core>
#include <vector>

#include "problems/robust_loss.h"

namespace armcal {

// One row of every joint's equations in a fit. U: n x parameters; r: residuals
// in units of their noise, weighed by the loss, 0 where the equation is not
// used; slope: by which the loss passes on a residual's change.
struct FittedRow {
  Eigen::MatrixXd U;
  Eigen::VectorXd r;
  std::vector<bool> used;
  Eigen::VectorXd slope;
};

// The slope of a loss as an equation's information has it. Equations beyond
// the bend count a hundredth: where the few that tell a parameter happen to lie
// there (a log that hardly crosses standstill, and Coulomb friction's width),
// the data do not tell nothing of it. More would call them as good as the rest
// where they are there because the model does not hold.
double InformingSlope(const LossAt& loss);

// The covariance of an estimate x = gain * sum of scale_i u_i' r_i if errors
// follow each other only where rows overlap: from the products of the rows
// themselves and each joint's error autocovariances at the lags within a
// window. Much less noisy than what Newey-West makes of a short log, but blind
// to errors that last longer or are larger at some times.
class OverlapCovariance {
 public:
  OverlapCovariance(int num_joints, int num_parameters, int rows_per_window);

  void Add(const FittedRow& row);
  void Break();  // the next row does not follow the last
  // `scale` turns a joint's row times its residual into a score.
  Eigen::MatrixXd Value(const Eigen::MatrixXd& gain,
                        const Eigen::VectorXd& scale);

 private:
  // Sums of u(t)' u(t - d) of a joint: as they are, times the mean slope of
  // both ends, times both slopes.
  struct Squares {
    Eigen::MatrixXd all, mean, both;
  };
  // A row for each of the last distances_ - 1 rows and then for the new ones,
  // whose products are still to be summed: many at a time.
  struct Recent {
    std::vector<Eigen::MatrixXd> U;  // per joint
    Eigen::MatrixXd r, slope, used;  // column per joint; 1: used, 0: not
    std::vector<int> num_before;     // rows that each follows, no more
    int added = 0;                   // new ones
  };
  void SumProducts();
  void AddSquares(int joint);
  int num_old() const { return distances_ - 1; }
  const Squares& Square(int i, int d) const {
    return squares_[i * distances_ + d];
  }
  Eigen::MatrixXd Taken(const Eigen::MatrixXd& gain,
                        const Eigen::VectorXd& scale, const Eigen::MatrixXd& c,
                        const Eigen::MatrixXd& covariance) const;

  int lags_, distances_;
  Eigen::VectorXd rows_;
  Eigen::MatrixXd products_;      // joint x lag: sums of r(t) r(t - lag)
  std::vector<Squares> squares_;  // joint, distance
  Recent recent_;
  bool follows_ = false;
};

// Standard deviations of `covariance` raised to those of variances `least`.
Eigen::MatrixXd RaiseTo(const Eigen::VectorXd& least,
                        const Eigen::MatrixXd& covariance);

}  // namespace armcal
