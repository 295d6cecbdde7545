#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/linear/calibration.h"
#include "calib/logs/log_set.h"
#include "model/robot/robot.h"

namespace armcal {

// A linear calibration made better by maximum likelihood, in which recorded
// positions are as uncertain as recorded torques.
struct TrajectoryRefinement {
  // The refined one, its `noise` that of single torque samples, its `outliers`
  // counted in samples; or the start, where `refined` is false.
  LinearCalibration calibration;
  bool refined = false;
  bool converged = false;
  std::string reason;  // why it stopped, or why it could not be done
  double knot_s = 0;   // of the splines
};

// From the solution `start` of CalibrateLinear (weighted, weak rows) for the
// same logs and options: Gauss-Newton over the parameters, the transition
// widths of Coulomb friction where they were fitted, and splines of all motions
// with knots half a period of the bandwidth apart (TrajectoryCorrection). Noise
// is re-estimated on the way; torques count by Huber's loss where the options
// say so. What the start could not see stays as it is.
TrajectoryRefinement RefineTrajectories(const Robot& robot,
                                        const LinearCalibrationOptions& options,
                                        const LinearCalibration& start,
                                        const LogSet& training,
                                        const LogSet* validation);

}  // namespace armcal
