#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace armcal {

// Whitened torque of one unit of something, per joint; empty where it is zero.
using JointRows = std::vector<Eigen::VectorXd>;

// The regression that all questions of a diagnosis are asked of: torque
// residual on the baseline's columns, each with a standard normal prior, and
// candidates without one. Candidates are projected on what the baseline cannot
// absorb (Frisch and Waugh 1933; Plumlee 2017: a discrepancy orthogonal to the
// model), so that whatever is asked afterwards needs the small matrices G and g
// only:
//   drop of chi^2 by a set S of candidate columns = g_S' G_SS^-1 g_S.
class GapScreen {
 public:
  // baseline: per joint rows x size; target: the whitened residual of the
  // robot as the file has it.
  GapScreen(std::vector<Eigen::MatrixXd> baseline, JointRows target);

  // What other data (a reference log) tell of the baseline: A'A and A'y. Once.
  void AddInformation(const Eigen::MatrixXd& AtA, const Eigen::VectorXd& Aty);
  // Returns the index of the column.
  int AddColumn(JointRows column);
  // Solves with the columns that there are; what was solved with those before
  // is kept.
  void Factor();

  int size() const { return static_cast<int>(columns_.size()); }
  int num_joints() const { return static_cast<int>(target_.size()); }
  int num_rows(int joint) const {
    return static_cast<int>(target_[joint].size());
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
    double drop = 0;             // of chi^2 against the baseline alone
  };
  Fit Solve(const std::vector<int>& columns) const;
  // Drop of chi^2 by columns that are not among those of the screen.
  double DropOf(const std::vector<JointRows>& columns) const;
  // Estimates of the baseline with these columns fitted.
  Eigen::VectorXd Baseline(const Fit& fit) const;
  // Whitened residual of joint j.
  Eigen::VectorXd Residual(int joint, const Fit& fit) const;
  // The baseline that fits best beside a torque (whitened, per joint).
  Eigen::VectorXd BaselineBeside(const JointRows& torque) const;
  // What that leaves, all joints, the prior's and other data's share included:
  // its squared norm is chi^2.
  Eigen::VectorXd ResidualBeside(const JointRows& torque) const;
  // Joint j's rows of a column, less what the baseline absorbs of it.
  Eigen::VectorXd Projected(int column, int joint) const;
  // Covariance of the baseline's values alone.
  Eigen::MatrixXd BaselineCovariance() const;

 private:
  // What a joint's rows add of the columns that are new.
  struct Products {
    std::vector<int> all, added;  // columns that the joint has
    Eigen::MatrixXd by_columns;   // all' added
    Eigen::MatrixXd by_baseline;  // baseline' added
    Eigen::VectorXd by_target;    // added' target
  };
  Products ProductsOf(int joint) const;

  std::vector<Eigen::MatrixXd> baseline_;
  JointRows target_;
  std::vector<JointRows> columns_;
  Eigen::MatrixXd information_;  // of the baseline, prior included
  Eigen::VectorXd gradient_;
  // Other data: root of their information, and what they say of the baseline.
  Eigen::MatrixXd known_root_;
  Eigen::VectorXd known_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  int factored_ = -1;      // columns; -1: nothing yet
  Eigen::MatrixXd cross_;  // baseline' columns
  Eigen::MatrixXd half_;   // the factor's inverse times that
  Eigen::MatrixXd G_;
  Eigen::VectorXd g_, raw_;
};

}  // namespace armcal
