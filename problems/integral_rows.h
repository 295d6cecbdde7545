#pragma once

#include <vector>

#include "problems/identification_rows.h"

namespace armcal {

// The integral model (2.27): over an interval (t1, t2),
//   int tau dt = sum_c X_c [ P_c(t2) - P_c(t1) - int D_c dt ],
// by the trapezoid or Simpson's rule on the samples; the ends are moved to the
// nearest sample. A given interval is assigned to the trajectory whose core
// holds its beginning, and left out where a gap cuts it.
class IntegralRows : public IdentificationRows {
 public:
  // Of the trajectory that `functions` have entered.
  IntegralRows(const Trajectory& trajectory, const RowOptions& options,
               const MotionFunctions& functions);

  long size() const override { return static_cast<long>(intervals_.size()); }
  double time(long row) const override;
  void Evaluate(long begin, long count, double* const* out, long stride,
                RowScratch* scratch) const override;

 private:
  // The first and the last sample of each.
  struct Interval {
    int begin, end;
  };
  void ListIntervals(const RowOptions& options);
  void ListEqualIntervals(const RowOptions& options);
  bool Useless(const Interval& interval) const;
  void EvaluateRow(const Interval& interval, double* const* out, long stride,
                   RowScratch* scratch) const;

  const Trajectory& trajectory_;
  const MotionFunctions& functions_;
  Quadrature quadrature_;
  std::vector<Interval> intervals_;
};

}  // namespace armcal
