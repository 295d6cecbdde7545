#include "calib/calibration_model.h"

#include <algorithm>

#include "model/input_error.h"
#include "model/input_text.h"

namespace armcal {

RowOptions MakeRowOptions(const LinearCalibrationOptions& options,
                          const LogSet& training) {
  RowOptions rows;
  rows.bandwidth_hz =
      options.bandwidth_hz.value_or(DefaultBandwidth(training.time_bases()));
  rows.identification = options.identification;
  rows.window_s = options.window_s.value_or(
      rows.bandwidth_hz > 0 ? std::max(0.3, 1.5 / rows.bandwidth_hz) : 0.5);
  rows.intervals = options.intervals;
  rows.interval_s = options.interval_s;
  rows.quadrature = options.quadrature;
  return rows;
}

ModelParameters MakeParameters(const Robot& robot,
                               const LinearCalibrationOptions& options,
                               const Transitions& transitions) {
  ModelParameters::Options model;
  model.geometry = options.geometry;
  model.joint_terms = options.joint_terms;
  model.transitions = transitions;
  return ModelParameters(robot, model);
}

void CheckBandwidth(const std::optional<double>& given, const LogSet& logs) {
  if (!given || *given == 0) return;
  double longest = 0, slowest = 0;
  for (const TimeBase& base : logs.time_bases()) {
    longest = std::max(longest, base.range.end - base.range.begin);
    slowest = std::max(slowest, base.dt);
  }
  if (*given >= 0.5 / slowest) {
    throw InputError("", "--bandwidth", NumberText(*given),
                     "expected 0, or less than half the sample rate, " +
                         NumberText(0.5 / slowest) + " Hz");
  }
  if (*given * longest >= 1) return;
  throw InputError("", "--bandwidth", NumberText(*given),
                   "expected 0, or a frequency in Hz whose period is shorter "
                   "than the log, " +
                       NumberText(longest) + " s");
}

}  // namespace armcal
