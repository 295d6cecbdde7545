#include "problems/differential_rows.h"

#include <algorithm>
#include <cmath>

#include "model/signals/low_pass.h"

namespace armcal {

using Eigen::MatrixXd;

double DifferentialReach(const RowOptions& options) {
  return LowPassMemory(options.bandwidth_hz);
}

// Chooses the samples that become rows. Low-passed rows that lie closer than a
// quarter of the bandwidth's period tell the same thing again: they cost time,
// and their errors would be counted as independent. Places are multiples of
// `apart` from the segment's beginning and not from the trajectory's, so that
// the rows do not depend on how a log was cut into blocks.
DifferentialRows::DifferentialRows(const Trajectory& trajectory,
                                   const RowOptions& options,
                                   const MotionFunctions& functions)
    : trajectory_(trajectory), functions_(functions) {
  const double dt = trajectory.dt;
  const bool filter = options.bandwidth_hz > 0;
  const long apart =
      filter
          ? std::max(1L, static_cast<long>(0.25 / (options.bandwidth_hz * dt)))
          : 1;
  // What lies beyond the ends of a log the filter has to invent.
  const int edge =
      filter ? static_cast<int>(std::ceil(1.5 / (options.bandwidth_hz * dt)))
             : 0;
  for (int k = std::max(edge, trajectory.core_begin);
       k < std::min(trajectory.size() - edge, trajectory.core_end); ++k) {
    if ((trajectory.first_index + k) % apart != 0 || functions.Useless(k)) {
      continue;
    }
    samples_.push_back(k);
  }
  if (filter) Filter(options.bandwidth_hz);
}

// Passes each column of U, and tau, through one filter F. The model is linear
// in X, so that F tau = (F U) X holds for any linear F. A filter of tau alone
// would bias X; one of both only weighs the frequencies.
void DifferentialRows::Filter(double bandwidth_hz) {
  std::vector<double*> columns;
  for (const int size : RowSizes(functions_, 1)) {
    filtered_.emplace_back(trajectory_.size(), size);
    columns.push_back(filtered_.back().data());
  }
  EvaluateRun(0, trajectory_.size(), columns.data(), trajectory_.size());
  for (MatrixXd& C : filtered_) {
    C = ZeroPhaseLowPass(C, 1 / trajectory_.dt, bandwidth_hz);
  }
}

// Writes U and tau, as they are, of samples that follow each other.
void DifferentialRows::EvaluateRun(int first, long count, double* const* out,
                                   long stride) const {
  functions_.Differential(first, static_cast<int>(count), out, stride);
  const auto& columns = functions_.row_columns();
  for (size_t i = 0; i < columns.size(); ++i) {
    std::copy_n(trajectory_.tau.col(static_cast<int>(i)).data() + first, count,
                out[i] + static_cast<long>(columns[i].size()) * stride);
  }
}

// Filtered rows are copied. Others are evaluated now, in runs of samples that
// follow each other, as the kernels take several samples in one instruction.
void DifferentialRows::Evaluate(long begin, long count, double* const* out,
                                long stride, RowScratch*) const {
  const size_t n = functions_.row_columns().size();
  for (size_t i = 0; i < filtered_.size(); ++i) {
    for (Eigen::Index c = 0; c < filtered_[i].cols(); ++c) {
      for (long r = 0; r < count; ++r) {
        out[i][c * stride + r] = filtered_[i](samples_[begin + r], c);
      }
    }
  }
  if (!filtered_.empty()) return;
  std::vector<double*> at(n);
  for (long r = 0; r < count;) {
    const int first = samples_[begin + r];
    long run = 1;
    while (r + run < count && samples_[begin + r + run] == first + run) ++run;
    for (size_t i = 0; i < n; ++i) at[i] = out[i] + r;
    EvaluateRun(first, run, at.data(), stride);
    r += run;
  }
}

}  // namespace armcal
