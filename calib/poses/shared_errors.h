#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// What the errors of measured poses make of an estimate. They are not as many
// independent ones as there are coordinates:
//
// - Several readings share the error of one pose, several targets on the tool
//   or a pose that was read more than once. An arm that does not stand where
//   its model says is displaced and turned as a whole.
// - Neighbouring poses share what their joints err by, which changes with the
//   position of the joint: what a geometry lacks is mostly of that kind. Such
//   an error has the joint's lever, and much of it goes into the estimate
//   instead of into what is left.
// - All poses share what the file's geometry errs by where it is not estimated.
//
// Counted as independent they make intervals too small by the root of how many
// there are. Here each has a variance, estimated of what is left: of
// coordinates, of poses, of joints' harmonics, and of the file's parameters in
// units of their priors. All harmonics have one variance, since the motion of a
// single joint tells too little, and so have all parameters.
//
// `basis` has orthonormal columns Q that span the free columns of the Jacobian
// `by_all`, a row for each of `residuals` (in noise units, of the poses `rows`)
// and more for priors below. The result B is the covariance of Q'psi / slope
// (ScoresOf), so that
//   (J'J)^-1 J'Q B Q'J (J'J)^-1
// is the covariance of the estimate: the sandwich of Huber (1967) with what is
// shared in one piece (Liang and Zeger 1986).
Eigen::MatrixXd PoseScoreCovariance(const PoseFit& fit,
                                    const std::vector<int>& rows,
                                    const Eigen::MatrixXd& by_all,
                                    const Eigen::VectorXd& residuals,
                                    const Eigen::MatrixXd& basis);

}  // namespace armcal
