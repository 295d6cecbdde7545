#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/closed_loop/simulation.h"
#include "model/dynamics/joint_controller.h"

namespace armcal {

// What an encoder's noise makes of a closed loop's measured positions: the
// noise itself and, as the controller takes it for motion, the motion that it
// causes. Positions of simulated loops lack both. All of it is known from the
// loop, linear about `track`; `periods`: of LoopTangent.
//
// The covariance of weights' residuals, m x m, where noise is white with
// standard deviation `noise` per joint, rad or m; one weight of each row of
// residuals in each of the m columns. By the adjoint loop, backwards in time.
Eigen::MatrixXd LoopNoiseCovariance(const ControllerOptions& controller,
                                    const LoopValues& values,
                                    const LoopStretch& stretch,
                                    const LoopTrack& track,
                                    const std::vector<Eigen::MatrixXd>& periods,
                                    const Eigen::VectorXd& noise,
                                    const Eigen::MatrixXd& weights);

}  // namespace armcal
