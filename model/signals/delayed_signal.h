#pragma once

#include <Eigen/Core>

namespace armcal {

// A signal (samples x any) as it was `delay` samples before, linear between
// samples; a negative delay is what is yet to come. Before the first sample and
// after the last it stays what it is there.
Eigen::MatrixXd Delayed(const Eigen::MatrixXd& signal, double delay);

}  // namespace armcal
