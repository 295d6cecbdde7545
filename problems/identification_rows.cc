#include "problems/identification_rows.h"

#include <algorithm>

#include "problems/differential_rows.h"
#include "problems/integral_rows.h"
#include "problems/weak_rows.h"

namespace armcal {

double RowReach(const RowOptions& options) {
  switch (options.identification) {
    case Identification::kWeak:
      return options.window_s;
    case Identification::kDifferential:
      return options.bandwidth_hz > 0 ? DifferentialReach(options) : 0;
    case Identification::kIntegral:
      break;
  }
  double reach = options.intervals.empty() ? options.interval_s : 0;
  for (const TimeRange& interval : options.intervals) {
    reach = std::max(reach, interval.end - interval.begin);
  }
  return reach;
}

MotionRegressor::MotionRegressor(const ModelParameters& parameters)
    : parameters_(parameters),
      regressor_(parameters.MakeRegressor()),
      coulomb_(regressor_.columns().terms) {}

void MotionRegressor::Enter(const Trajectory& trajectory) {
  trajectory_ = &trajectory;
  states_ = coulomb_.Follow(trajectory);
}

void MotionRegressor::Momentum(int sample, Eigen::MatrixXd* P,
                               Eigen::MatrixXd* D) {
  regressor_.Momentum(trajectory_->q.row(sample), trajectory_->qd.row(sample),
                      states_.row(sample), P, D);
}

void MotionRegressor::Differential(int sample, Eigen::MatrixXd* U) {
  regressor_.Differential(trajectory_->q.row(sample),
                          trajectory_->qd.row(sample),
                          trajectory_->qdd.row(sample), states_.row(sample), U);
}

bool MotionRegressor::Useless(int sample) const {
  return coulomb_.size() > 0 && trajectory_->standstill[sample];
}

void ForEachRow(const Trajectory& trajectory, const RowOptions& options,
                MotionRegressor* regressor, const RowSink& sink) {
  regressor->Enter(trajectory);
  switch (options.identification) {
    case Identification::kWeak:
      return ForEachWeakRow(trajectory, options, regressor, sink);
    case Identification::kDifferential:
      return ForEachDifferentialRow(trajectory, options, regressor, sink);
    case Identification::kIntegral:
      return ForEachIntegralRow(trajectory, options, regressor, sink);
  }
}

}  // namespace armcal
