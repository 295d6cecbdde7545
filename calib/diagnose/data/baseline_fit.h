#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "calib/diagnose/data/baseline_columns.h"
#include "calib/diagnose/data/column_prior.h"
#include "calib/numerics/arrow_factor.h"

namespace armcal {

// Whitened torque of one unit of something, per joint; empty where it is zero.
using JointRows = std::vector<Eigen::VectorXd>;

// The regression of whitened torque on the baseline's columns within their
// prior. Most columns act on one joint only: the information on
// them is an arrow (ArrowFactor). Copies share rows, and new weights need
// products of rows only.
class BaselineFit {
 public:
  // Rows of one joint and their inner products.
  struct Rows {
    BaselineColumns columns;
    Eigen::VectorXd target;
    Eigen::MatrixXd of_columns;  // columns' columns
    Eigen::VectorXd of_target;   // columns' target
    double target_squared = 0;

    void Multiply();
  };
  // Where the columns of one joint are in its arm of the factor, and in what is
  // common to all arms.
  struct Places {
    std::vector<int> own, in_arm;        // of BaselineColumns::which
    std::vector<int> shared, in_common;  // the same
  };

  // Of `size` columns in all.
  BaselineFit(std::vector<BaselineColumns> columns, int size, JointRows target,
              ColumnPrior prior = {});

  // Whitened rows of other data (a reference log). Once.
  void AddKnown(const std::vector<BaselineColumns>& columns,
                const JointRows& target);
  // Multiplies joint j's rows by factor[j].
  void Weigh(const Eigen::VectorXd& factor);
  // Multiplies these columns.
  void Scale(const std::vector<int>& which, double factor);
  // After any of these.
  void Factor();

  int size() const { return static_cast<int>(scale_.size()); }
  int num_joints() const { return static_cast<int>(weight_.size()); }
  // Joint j's rows as they came.
  const Rows& rows(int joint) const { return (*rows_)[joint]; }
  const Places& places(int joint) const { return places_[joint]; }
  double weight(int joint) const { return weight_[joint]; }
  const ColumnPrior& prior() const { return prior_; }
  // What its columns are multiplied by, weight included.
  Eigen::VectorXd ScaleOf(int joint) const;
  const ArrowFactor& factor() const { return factor_; }
  // A'y, and its halves as of ArrowFactor.
  const Eigen::VectorXd& gradient() const { return gradient_; }
  const Eigen::VectorXd& arm_gradient(int joint) const {
    return arm_gradient_[joint];
  }
  const Eigen::VectorXd& common_gradient() const { return common_gradient_; }

  // Joint j's whitened torque at these values.
  Eigen::VectorXd Torque(int joint, const Eigen::VectorXd& x) const;
  // Adds its columns' products with whitened rows.
  void AddProducts(int joint, const Eigen::VectorXd& rows,
                   Eigen::Ref<Eigen::VectorXd> products) const;
  // Residual of other data, of as many rows as they tell of columns.
  Eigen::VectorXd KnownResidual(const Eigen::VectorXd& x) const;
  // Values that fit best given a torque (whitened, per joint).
  Eigen::VectorXd ValuesGiven(const JointRows& torque) const;
  // The same of the first `columns` alone, 0 for the others.
  Eigen::VectorXd ValuesGiven(const JointRows& torque, int columns) const;
  // What that leaves, all joints, the prior's and other data's share included:
  // its squared norm is chi^2.
  Eigen::VectorXd ResidualGiven(const JointRows& torque) const;
  // How many of joint j's rows are fitted: tr(A_j C A_j'), C the covariance.
  Eigen::VectorXd FittedRows() const;
  Eigen::MatrixXd Covariance() const;
  // Its inverse.
  Eigen::MatrixXd Information() const { return Information(size()); }

 private:
  void FindArms();
  Eigen::MatrixXd Information(int columns) const;
  Eigen::VectorXd GradientGiven(const JointRows& torque) const;

  std::shared_ptr<const std::vector<Rows>> rows_;
  // Of other data: the root of what they tell, as if these were their rows.
  std::shared_ptr<const std::vector<Rows>> known_;
  ColumnPrior prior_;
  Eigen::VectorXd weight_;  // of each joint's rows
  Eigen::VectorXd scale_;   // of columns

  std::vector<std::vector<int>> arms_;  // per joint
  std::vector<Places> places_;
  ArrowFactor factor_;  // of the information, prior included
  Eigen::VectorXd gradient_, common_gradient_;
  std::vector<Eigen::VectorXd> arm_gradient_;
};

}  // namespace armcal
