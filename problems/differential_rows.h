#pragma once

#include <Eigen/Core>
#include <vector>

#include "problems/identification_rows.h"

namespace armcal {

// The differential model (2.19): tau = U(q, qd, qdd) X at sample times. With a
// bandwidth both sides are low-passed alike and taken 4 times per period of it;
// without one every sample is a row.
class DifferentialRows : public IdentificationRows {
 public:
  // Of the trajectory that `functions` have entered.
  DifferentialRows(const Trajectory& trajectory, const RowOptions& options,
                   const MotionFunctions& functions);

  long size() const override { return static_cast<long>(samples_.size()); }
  double time(long row) const override {
    return trajectory_.time(samples_[row]);
  }
  void Evaluate(long begin, long count, double* const* out, long stride,
                RowScratch* scratch) const override;

 private:
  void Filter(double bandwidth_hz);
  void EvaluateRun(int first, long count, double* const* out,
                   long stride) const;

  const Trajectory& trajectory_;
  const MotionFunctions& functions_;
  std::vector<int> samples_;  // of each row
  // Per joint its columns and the torque at every sample; empty: not filtered.
  std::vector<Eigen::MatrixXd> filtered_;
};

double DifferentialReach(const RowOptions& options);

}  // namespace armcal
