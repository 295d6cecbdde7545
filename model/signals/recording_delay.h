#pragma once

#include <Eigen/Core>

#include "model/signals/motion.h"

namespace armcal {

// What a delay of the recording adds to a recorded torque, samples x joints, N
// m or N, where the motors gave `given`: given(t - delay) - given(t). A
// negative delay is that of motors which give later what was recorded.
//
// A model that is 5 % wrong leaves 5 % of its delay, which other parameters
// then take for theirs. What is slow is therefore moved in the recording
// itself, and only what is fast, where recordings are noisy, in the model's
// torque.
Eigen::MatrixXd ChangeByDelay(const Eigen::MatrixXd& given,
                              const SmoothTorque& recorded, double dt,
                              double delay);

// The same per second of a small delay.
Eigen::MatrixXd SlopeByDelay(const Eigen::MatrixXd& given,
                             const SmoothTorque& recorded, double dt);

}  // namespace armcal
