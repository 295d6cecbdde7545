#pragma once

#include <Eigen/Core>

namespace armcal {

// A signal (samples x any) as it was `delay` samples before; a negative delay
// is what is yet to come. Between samples it is the polynomial through the six
// around, which at a fifth of the sampling rate has .985 of a sine's amplitude
// at the least (a line .81), and a line at the ends. Before the first sample
// and after the last it goes on straight, by the line closest to as many
// samples there as the delay has, and to six at least.
Eigen::MatrixXd Delayed(const Eigen::MatrixXd& signal, double delay);

}  // namespace armcal
