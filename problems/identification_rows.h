#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "model/log_files/time_base.h"
#include "model/signals/trajectory.h"
#include "problems/identification.h"
#include "problems/joint_columns.h"
#include "problems/motion_functions.h"

namespace armcal {

struct RowOptions {
  Identification identification = Identification::kWeak;
  double window_s = 0.5;  // weak: length of the test functions
  int hops = 4;           // weak: windows start every window_s / hops
  // Integral: the intervals (t1, t2) in s since the log's first row; empty:
  // intervals of interval_s side by side.
  std::vector<TimeRange> intervals;
  double interval_s = 0.5;
  Quadrature quadrature = Quadrature::kTrapezoid;
  double bandwidth_hz = 0;  // differential: low pass of U and tau, 0: none
};

// One equation per joint: row i of U (n x parameters) and Y (n), N m (N), or
// N m s (N s) for the integral model.
struct IdentificationRow {
  double time = 0;  // s, its middle
  Eigen::MatrixXd U;
  Eigen::VectorXd Y;
};
// What evaluations need room for; one per thread.
struct RowScratch {
  JointColumns P, D;
  std::vector<double> products;
};
using RowSink = std::function<void(const IdentificationRow&)>;

// The rows of a trajectory's core in order of time, but for those that reach
// into a useless sample. Any number of threads may evaluate them; a row is the
// same bits whichever others it is evaluated with. Trajectory and functions
// must stay.
class IdentificationRows {
 public:
  virtual ~IdentificationRows() = default;
  virtual long size() const = 0;
  virtual double time(long row) const = 0;  // s, its middle
  // Rows begin .. begin + count - 1: of joint i, its row_columns() and then the
  // right side, column c of row begin + r at out[i][c * stride + r].
  virtual void Evaluate(long begin, long count, double* const* out, long stride,
                        RowScratch* scratch) const = 0;
};

// Some of them, evaluated together.
struct RowBatch {
  long begin = 0, count = 0;
  JointColumns columns;  // per joint, the right side last

  void Evaluate(const IdentificationRows& rows,
                const MotionFunctions& functions, RowScratch* scratch);
  // `sink` gets every row in *row.
  void ForEachRow(const IdentificationRows& rows,
                  const MotionFunctions& functions, IdentificationRow* row,
                  const RowSink& sink) const;
};

// Calls `sink` for every row, in order.
void ForEachRow(const IdentificationRows& rows,
                const MotionFunctions& functions, const RowSink& sink);
}  // namespace armcal
