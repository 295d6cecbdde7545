#pragma once

#include <Eigen/Core>

namespace armcal {

// d/dt of each column of x at times t (s, rising, not evenly; a row of x each):
// that of the polynomial through the `points` nearest rows. Five for what is
// smooth; three for what is noisy, which these make no worse. Where there are
// fewer rows, of all of them; of one: 0.
Eigen::MatrixXd DifferentiateUneven(const Eigen::VectorXd& t,
                                    const Eigen::MatrixXd& x, int points = 5);

}  // namespace armcal
