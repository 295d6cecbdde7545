#pragma once

#include <Eigen/Core>

namespace armcal {

// Times of rows `t` (s, two or more, their steps as the joints tell them) moved
// so that their mean over a second is that of the stamps. Stamps that jitter
// are right in such a mean; joints' steps are in the small, but have the scale
// of recorded velocities for their rate, and their errors add up. Begins at 0,
// and never goes back.
Eigen::VectorXd WithMeansOf(const Eigen::VectorXd& stamps,
                            const Eigen::VectorXd& t);

}  // namespace armcal
