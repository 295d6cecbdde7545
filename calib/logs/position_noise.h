#pragma once

#include <Eigen/Core>
#include <vector>

namespace armcal {

// Standard deviation of white noise of recorded positions (samples x n, equally
// spaced), resolution included, n entries, rad or m: from their fifth
// differences, of which motion below a twentieth of the sample rate has next to
// nothing, by the median, so that friction's jerks do not count. Differences
// that are 0, of an encoder that stands, tell nothing; 0 where all are. Of the
// others the `slowest` share counts, by how far the joint moves meanwhile: what
// stamps that jitter make of a motion is not there where it turns round.
Eigen::VectorXd PositionNoise(const Eigen::MatrixXd& q, double slowest = 1);
// The same of several shares, which fall, a column each.
Eigen::MatrixXd PositionNoise(const Eigen::MatrixXd& q,
                              const std::vector<double>& slowest);

}  // namespace armcal
