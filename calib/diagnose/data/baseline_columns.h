#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// The columns of a baseline that act on one joint: most act on few, and those
// of how friction and discrepancy vary on one only.
struct BaselineColumns {
  std::vector<int> which;  // of all columns, ascending
  Eigen::MatrixXd values;  // samples (or rows) x which.size()

  // Their sum at these values of all columns.
  Eigen::VectorXd Times(const Eigen::VectorXd& x) const {
    return values * x(which);
  }
  // One of all columns; empty where it does not act.
  Eigen::VectorXd Column(int column) const;
  // Several of them, zero where they do not act.
  Eigen::MatrixXd Select(const std::vector<int>& columns) const;
  // As if there were only as many of all columns.
  void KeepFirst(int columns);
  // As if it did not act.
  void Remove(int column);
  // One that it does not have.
  void Insert(int column, const Eigen::VectorXd& more);
};

// Of columns that may all act on each joint (samples x columns).
std::vector<BaselineColumns> OnEachJoint(std::vector<Eigen::MatrixXd> values);

}  // namespace armcal
