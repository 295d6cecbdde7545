#include "calib/fleet/reduction.h"

namespace armcal {

LinearCalibrationOptions ReductionModel::Options() const {
  LinearCalibrationOptions options;
  options.geometry = geometry;
  options.joint_terms = joint_terms;
  options.joint_transitions = transitions;
  options.identification = rows.identification;
  options.window_s = rows.window_s;
  options.interval_s = rows.interval_s;
  options.quadrature = rows.quadrature;
  options.bandwidth_hz = rows.bandwidth_hz;
  options.loss = loss;
  return options;
}

}  // namespace armcal
