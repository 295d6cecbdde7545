#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/commanded_reference.h"
#include "calib/closed_loop/values.h"
#include "model/log_files/log.h"

namespace armcal {

// Rows of a log that a loop is simulated along, and the command that it follows
// there. A control period begins at the first row.
class LoopStretch {
 public:
  // Log and command are kept by reference.
  LoopStretch(const Log& log, const CommandedReference& command, long first_row,
              long num_rows, double period);

  const Log& log() const { return log_; }
  long first_row() const { return first_row_; }
  long num_rows() const { return static_cast<long>(period_of_row_.size()); }
  double period() const { return period_; }  // s
  long num_periods() const { return period_of_row_.back() + 1; }
  // In which period row k lies, and after which share of it.
  long period_of(long k) const { return period_of_row_[k]; }
  double share_of(long k) const { return share_of_row_[k]; }

  // What the controller follows, a row each period, if commands come `delay` s
  // late.
  ReferenceSeries Reference(double delay) const;
  // Where the log shows that it starts.
  LoopStart Start() const;

 private:
  const Log& log_;
  const CommandedReference& command_;
  long first_row_;
  double period_;
  std::vector<long> period_of_row_;
  std::vector<double> share_of_row_;
  mutable ReferenceSeries near_;  // at near_delay_: the command's splines are
  mutable double near_delay_;     // dear
};

// How a row lies between the begin and the end of its period, s: the position
// by q and qd there, a Hermite cubic.
struct RowWeights {
  RowWeights(double share, double period);
  double q0, qd0, q1, qd1;
};

}  // namespace armcal
