#pragma once

#include <Eigen/Core>

namespace armcal {

// Replaces single samples that stick out of a signal by what is around them:
// where a sample differs from the median of the five around it by more than 8
// times what such differences usually are (their 90th percentile, as a standard
// deviation), it becomes that median. Steps and peaks of three samples or more
// stay, and so does everything where most samples equal their neighbours.
// Columns of x are treated apart. Returns which samples were replaced.
Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> RemoveSpikes(
    Eigen::MatrixXd* x);

}  // namespace armcal
