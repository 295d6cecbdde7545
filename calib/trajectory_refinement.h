#pragma once

#include <Eigen/Core>
#include <string>

#include "calib/linear_calibration.h"
#include "calib/log_set.h"
#include "model/robot.h"

namespace armcal {

// A linear calibration made better by maximum likelihood, in which recorded
// positions are as uncertain as recorded torques.
struct TrajectoryRefinement {
  explicit TrajectoryRefinement(const LinearCalibration& start)
      : calibration(start) {}

  // Refined where `refined`, else the start. `noise` is that of single torque
  // samples, `outliers` counts samples.
  LinearCalibration calibration;
  bool refined = false;
  bool converged = false;
  std::string reason;  // why it stopped, or why it was refused
  int passes = 0;
  double knot_s = 0;              // of the splines
  Eigen::VectorXd encoder_noise;  // per joint, of single samples, rad or m
  // How much larger than white noise the torque residuals are in the long run:
  // their variance over blocks of a quarter second over that of white noise.
  double whiteness = 1;
};

// From the solution `start` of CalibrateLinear, for the same logs and options:
// Gauss-Newton over the parameters, the transition widths of Coulomb friction
// (where fitted) and splines of all motions (TrajectoryCorrection), with noise
// re-estimated on the way; Huber's loss on torques where the options say so.
// Standard deviations are those of independent samples; where residuals are
// autocorrelated, at least those of the scores' long-run covariance.
TrajectoryRefinement RefineTrajectories(const Robot& robot,
                                        const LinearCalibrationOptions& options,
                                        const LinearCalibration& start,
                                        LogSet* training, LogSet* validation);

}  // namespace armcal
