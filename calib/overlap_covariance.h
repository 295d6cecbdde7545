#pragma once

#include <Eigen/Core>
#include <deque>
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
                        const Eigen::VectorXd& scale) const;

 private:
  // Sums of u(t)' u(t - d) of a joint: as they are, times the mean slope of
  // both ends, times both slopes.
  struct Squares {
    Eigen::MatrixXd all, mean, both;
  };
  // One joint's row of U from its first to its last number that is not 0.
  struct Equation {
    Eigen::Index begin;
    Eigen::VectorXd u;
  };
  struct Recent {
    explicit Recent(const FittedRow& row);
    Eigen::VectorXd r, slope;
    std::vector<Equation> equations;  // per joint
  };
  static void AddSquare(const Equation& u, const Equation& v, double mean,
                        double both, bool overlaps, Squares* squares);
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
  std::deque<Recent> recent_;
};

// Standard deviations of `covariance` raised to those of variances `least`.
Eigen::MatrixXd RaiseTo(const Eigen::VectorXd& least,
                        const Eigen::MatrixXd& covariance);

}  // namespace armcal
