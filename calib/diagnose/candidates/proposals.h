#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/candidates/search.h"
#include "calib/diagnose/data/rows.h"

namespace armcal {

// What a residual proposes for the parameters of effects that are looked for
// in it: frequencies and times.
class GapProposals {
 public:
  // Keeps references. residual: thinned samples x n, N m or N.
  GapProposals(const GapRows& rows, const Eigen::MatrixXd& residual);

  // Of torques that repeat with a joint's position, 1/rad or 1/m.
  std::vector<double> Harmonics(int joint) const;
  // Of torques that repeat in time, Hz. None at which a joint swings: whatever
  // depends on the state repeats there as well.
  std::vector<double> Frequencies(int joint) const;
  int num_logs() const;
  // In which something happened; `searched`: of how many.
  std::vector<TimeWindow> Windows(int log, int* searched) const;

 private:
  double Unaliased(int joint, double f) const;
  bool IsOfMotion(double f) const;

  const GapRows& rows_;
  Eigen::MatrixXd q_, whitened_;
  Eigen::VectorXd t_;
};

}  // namespace armcal
