#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/diagnose/changes/course.h"
#include "calib/diagnose/changes/series_fit.h"
#include "calib/fleet/reduction.h"
#include "model/dynamics/model_parameters.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/log_files/time_range.h"
#include "model/robot/robot.h"

namespace armcal {

// Logs of one robot in the order they were recorded, each as what it says of
// the model parameters (base combinations, friction, offsets).
struct LogSeries {
  ModelParameters parameters;
  std::vector<std::string> logs;
  Eigen::VectorXd pooled;  // parameters, from all logs together
  Eigen::VectorXd torque;  // the parameter that makes a joint's torque
  Eigen::VectorXd noise;   // per joint, of equations, median of the logs
  LogMotions motions;      // rad/s and rad, or m/s and m
  // Of (parameters - pooled) / torque.
  std::vector<LogEquations> equations;
  // [joint]: what all of its torque once more would add to the right sides.
  std::vector<LogColumns> by_scale;

  int size() const { return static_cast<int>(logs.size()); }
  // Where a joint's term is among the parameters; -1: not by itself.
  int TermIndex(int joint, JointTerm term) const;
  // Each log's own estimate and its standard deviations (a column per log, in
  // the parameters' units); what it does not see is the pooled value, with an
  // infinite one. `inflation`: of variances.
  Eigen::MatrixXd Own(double inflation, Eigen::MatrixXd* stddev) const;
};

// The logs reduced to factors (log_reduction.h), one model for all.
Reduction ReduceSeries(const Robot& robot, const LogReaderOptions& reading,
                       const LinearCalibrationOptions& options,
                       const std::vector<LogSource>& logs,
                       const TimeRange& crop);
// From their factors; `logs` names them. Without equations where all logs
// together do not calibrate the robot.
LogSeries MakeSeries(const Robot& robot, const Reduction& reduction,
                     const std::vector<std::string>& logs);

}  // namespace armcal
