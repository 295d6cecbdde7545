#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/fit.h"

namespace armcal {

// What the errors of measured poses make of an estimate, where several readings
// share the error of one pose: several targets on the tool, or a pose that was
// read more than once. An arm that does not stand where its model says is
// displaced and turned as a whole, so that what is left of those readings is
// mostly one error and not as many as there are coordinates. Counted as
// independent they make intervals too small by the root of how many there are.
//
// `basis` has orthonormal columns Q that span the Jacobian's, a row for each of
// `residuals` (in noise units, of the poses `rows`) and more for priors below.
// The result B is the covariance of Q'psi / slope (ScoresOf), so that
//   (J'J)^-1 J'Q B Q'J (J'J)^-1
// is the covariance of the estimate: the sandwich of Huber (1967) with a
// pose's errors in one piece (Liang and Zeger 1986). Where no pose has two
// readings it is VarianceFactor() times the identity.
Eigen::MatrixXd ScoreCovariance(const PoseFit& fit,
                                const std::vector<int>& rows,
                                const Eigen::VectorXd& residuals,
                                const Eigen::MatrixXd& basis, int num_unknowns);

}  // namespace armcal
