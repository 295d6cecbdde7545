#include "calib/linear/calibration_model.h"

#include <algorithm>

#include "calib/linear/weak_window.h"
#include "model/signals/bandwidth.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "problems/make_rows.h"

namespace armcal {

// What nobody gives follows from the logs: the bandwidth from their time bases
// and the window from bandwidth, sample rate and encoder noise (weak_window.h).
RowOptions MakeRowOptions(const LinearCalibrationOptions& options,
                          const LogSet& training) {
  RowOptions rows;
  rows.bandwidth_hz =
      options.bandwidth_hz.value_or(DefaultBandwidth(training.time_bases()));
  rows.identification = options.identification;
  if (options.window_s) {
    rows.window_s = *options.window_s;
  } else if (rows.identification == Identification::kWeak &&
             rows.bandwidth_hz > 0) {
    rows.window_s = DefaultWindow(rows.bandwidth_hz, training);
  }
  rows.intervals = options.intervals;
  rows.interval_s = options.interval_s;
  rows.quadrature = options.quadrature;
  return rows;
}

PreparationOptions PreparationForRows(const RowOptions& rows,
                                      bool remove_spikes) {
  PreparationOptions prepared;
  prepared.bandwidth_hz = rows.bandwidth_hz;
  prepared.reach_s = RowReach(rows);
  prepared.remove_spikes = remove_spikes;
  return prepared;
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

std::optional<Transitions> GivenTransitions(
    const Robot& robot, const LinearCalibrationOptions& options) {
  if (options.transition) {
    return Transitions(robot.links.size(), {*options.transition});
  }
  if (options.joint_transitions.empty()) return {};
  Transitions transitions;
  for (const auto& t : options.joint_transitions) transitions.push_back({t});
  return transitions;
}

}  // namespace armcal
