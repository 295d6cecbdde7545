#pragma once

#include <vector>

#include "problems/identification_rows.h"

namespace armcal {

// The weak form: for a test function phi that vanishes at both ends,
//   int phi tau dt = sum_c X_c [ - int phi' P_c dt - int phi D_c dt ],
// with phi(s) = (1 - s^2)^4 on s in [-1, 1], scaled to int phi dt = 1 so that
// rows are mean torques (N m). No acceleration enters, and velocity only inside
// smooth averages (docs/theory.md, 2); a box for phi would give (2.27). The
// trapezoid rule has order 4 for it: with 50 samples in a window, 1e-6 of the
// torque. Windows start at multiples of their hop from the segment's first
// sample.
class WeakRows : public IdentificationRows {
 public:
  // Of the trajectory that `functions` have entered.
  WeakRows(const Trajectory& trajectory, const RowOptions& options,
           const MotionFunctions& functions);

  long size() const override { return static_cast<long>(cells_.size()); }
  double time(long row) const override;
  void Evaluate(long begin, long count, double* const* out, long stride,
                RowScratch* scratch) const override;

 private:
  struct Piece;
  struct Output;
  int FirstSample(long cell) const {
    return static_cast<int>(cell * hop_ - trajectory_.first_index);
  }
  void SetTestFunction();
  void ListWindows();
  void AddSamples(int first, int count, const Output& output,
                  RowScratch* scratch) const;
  void AddPiece(const Piece& piece, int joint, const Output& output,
                RowScratch* scratch) const;

  const Trajectory& trajectory_;
  const MotionFunctions& functions_;
  int steps_;
  // A cell reaches from one window's first sample to the next's; windows begin
  // with theirs and reach over phases_ of them.
  long hop_;
  int phases_;
  std::vector<long> cells_;  // of each row
  // phi and its rate times dt (quadrature weights) at a cell's samples, a
  // column per phase, the last phase first, zeros below.
  long weight_stride_;
  std::vector<double> phi_, rate_;
};

}  // namespace armcal
