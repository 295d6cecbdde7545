#pragma once

#include <Eigen/Core>
#include <memory>
#include <utility>
#include <vector>

#include "calib/diagnose/data/baseline_fit.h"
#include "calib/diagnose/data/chi2_given.h"

namespace armcal {

// The regression that all questions of a diagnosis are asked of: torque
// residual on the baseline's columns within their prior, and candidates without
// one. Candidates are projected on what the baseline cannot
// absorb (Frisch and Waugh 1933; Plumlee 2017: a discrepancy orthogonal to the
// model), so that whatever is asked afterwards needs the small matrices G and g
// only:
//   delta chi^2 of a set S of candidate columns = g_S' G_SS^-1 g_S.
// Copies share rows.
class GapScreen {
 public:
  // baseline: whitened, `size` columns in all; target: the whitened residual of
  // the robot as the file has it.
  GapScreen(std::vector<BaselineColumns> baseline, int size, JointRows target,
            ColumnPrior prior = {});

  // Whitened rows of other data (a reference log), which the baseline alone
  // fits. Once, before columns are factored.
  void AddKnown(const std::vector<BaselineColumns>& baseline,
                const JointRows& target);
  // Returns the index of the column.
  int AddColumn(JointRows column);
  // Multiplies joint j's rows by factor[j], as if its noise were so much
  // smaller.
  void Weigh(const Eigen::VectorXd& factor);
  // The same rows with these columns alone, factored.
  GapScreen Only(const std::vector<int>& columns) const;
  // Multiplies these columns of the baseline, as if they were so much more
  // uncertain.
  void ScaleBaseline(const std::vector<int>& which, double factor);
  // Solves with the columns that there are; what was solved with those before
  // is kept.
  void Factor();

  int size() const { return static_cast<int>(columns_.size()); }
  int num_joints() const { return baseline_.num_joints(); }
  int num_rows(int joint) const {
    return static_cast<int>(baseline_.rows(joint).target.size());
  }
  const Eigen::MatrixXd& G() const { return G_; }
  const Eigen::VectorXd& g() const { return g_; }
  // |c|^2 of a column before projection: G_cc / that is its visible share.
  double raw(int column) const { return raw_[column]; }
  // To add to G's diagonal: what the baseline absorbs wholly must not blow up,
  // nor what is not there, such as a weight on the axis of the only joint.
  double ridge(int column) const {
    return raw(column) > 0 ? 1e-9 * raw(column) : 1;
  }
  double visible(int column) const {
    return raw(column) > 0 ? G_(column, column) / raw(column) : 0;
  }

  // What g would be with another target (whitened, per joint).
  Eigen::VectorXd Gradient(const JointRows& target) const;
  // The same of parts of a target, one in each column: part_of_row says (per
  // joint) which part a row is of, 0 to `parts` - 1.
  Eigen::MatrixXd Gradients(const JointRows& target,
                            const std::vector<std::vector<int>>& part_of_row,
                            int parts) const;

  struct Fit {
    std::vector<int> columns;
    Eigen::VectorXd coefficients;
    Eigen::MatrixXd covariance;  // of them, baseline free
    double delta_chi2 = 0;       // against the baseline alone
  };
  Fit Solve(const std::vector<int>& columns) const;
  // Delta chi^2 of columns that are not among those of the screen.
  double DeltaChi2Of(const std::vector<JointRows>& columns) const;
  // Estimates of the baseline with these columns fitted.
  Eigen::VectorXd Baseline(const Fit& fit) const;
  // Whitened residual of all joints, and of one.
  JointRows Residuals(const Fit& fit) const;
  Eigen::VectorXd Residual(int joint, const Fit& fit) const {
    return ResidualGiven(joint, fit, Baseline(fit));
  }
  // The baseline that fits best given a torque (whitened, per joint).
  Eigen::VectorXd BaselineGiven(const JointRows& torque) const {
    return baseline_.ValuesGiven(torque);
  }
  // The same of its first `columns` alone, 0 for the others.
  Eigen::VectorXd BaselineGiven(const JointRows& torque, int columns) const {
    return baseline_.ValuesGiven(torque, columns);
  }
  // What that leaves, all joints, the prior's and other data's share included:
  // its squared norm is chi^2.
  Eigen::VectorXd ResidualGiven(const JointRows& torque) const {
    return baseline_.ResidualGiven(torque);
  }
  // That chi^2 of many torques (Chi2Given).
  Eigen::VectorXd Chi2Given(const std::vector<JointRows>& torques) const {
    return armcal::Chi2Given(baseline_, torques);
  }
  // A column's rows of all joints, less what the baseline absorbs of them.
  JointRows Projected(int column) const;
  // Of chi^2: what the baseline's values given `fit` cost by their prior and
  // other data.
  double PriorCost(const Fit& fit) const;
  // ln det of the information on the baseline and the columns of `fit`.
  double LogDeterminant(const Fit& fit) const;
  // How many of joint j's rows the baseline fits: tr(A_j C A_j'), C its
  // covariance.
  Eigen::VectorXd FittedRows() const { return baseline_.FittedRows(); }
  // Covariance of the baseline's values alone.
  Eigen::MatrixXd BaselineCovariance() const { return baseline_.Covariance(); }
  // Its inverse.
  Eigen::MatrixXd BaselineInformation() const {
    return baseline_.Information();
  }

 private:
  using Column = std::shared_ptr<const JointRows>;

  // Inner products of one joint's rows of columns, as these come.
  struct Products {
    std::vector<int> columns;     // that the joint has, ascending
    Eigen::MatrixXd of_columns;   // columns' columns
    Eigen::MatrixXd by_baseline;  // own baseline' columns
    Eigen::VectorXd by_target;    // columns' target

    // Those from `first` on that act on the joint.
    void Add(const std::vector<Column>& all, int first, int joint,
             const BaselineFit::Rows& rows);
    // With these columns alone, numbered as they come here.
    Products Only(const std::vector<int>& which) const;
  };

  // Of joint j with `fit`, whose Baseline() is x.
  Eigen::VectorXd ResidualGiven(int joint, const Fit& fit,
                                const Eigen::VectorXd& x) const;

  explicit GapScreen(BaselineFit baseline) : baseline_(std::move(baseline)) {}

  // Solves for the columns from `before` on, of cached products.
  void Project(int before);
  // Joint j's share of all that Project makes, of its columns (rows) and those
  // of them from `before` on (columns).
  struct ArmShare {
    Eigen::MatrixXd gram;    // products of what its arm of the baseline leaves
    Eigen::MatrixXd cross;   // with its columns of the baseline
    Eigen::MatrixXd common;  // what is left of them for the shared columns
    Eigen::VectorXd raw, g;  // as raw_ and g_
  };
  ArmShare ProjectOnArm(int joint, int before);
  void AddShares(const std::vector<ArmShare>& shares, int before,
                 Eigen::MatrixXd* G);

  BaselineFit baseline_;
  std::vector<Column> columns_;     // as if no rows were weighed
  std::vector<Products> products_;  // per joint, the same
  int factored_ = -1;               // columns; -1: nothing yet
  Eigen::MatrixXd cross_;           // baseline' columns
  // Halves of these, as of ArrowFactor.
  std::vector<Eigen::MatrixXd> arm_half_;  // per joint, of columns it has
  Eigen::MatrixXd common_half_;
  Eigen::MatrixXd G_;
  Eigen::VectorXd g_, raw_;
};

}  // namespace armcal
