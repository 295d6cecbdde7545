#pragma once

#include <Eigen/Core>

#include "calib/position_loop.h"
#include "model/joint_controller.h"

namespace armcal {

// What an encoder's noise makes of a closed loop's measured positions: the
// noise itself and, as the controller takes it for motion, the motion that it
// causes. Positions of simulated loops lack both. All of it is known from the
// loop, linear about `run` (of PositionLoop::Wanted::kPeriods).
//
// The covariance of weights' residuals, m x m, where noise is white with
// standard deviation `noise` per joint, rad or m; one weight of each row of
// residuals in each of the m columns. By the adjoint loop, backwards in time.
Eigen::MatrixXd LoopNoiseCovariance(const ControllerOptions& controller,
                                    const LoopValues& values,
                                    const LoopRun& run,
                                    const Eigen::VectorXd& noise,
                                    const Eigen::MatrixXd& weights);

}  // namespace armcal
