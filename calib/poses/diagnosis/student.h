#pragma once

#include <Eigen/Core>

namespace armcal {

// Errors whose size is not known, of poses that may be grossly wrong:
// multivariate Student's t of `width` coordinates a pose, all of one scale
//   -2 log p = sum_k [ (nu + d) log(1 + |r_k|^2 / (nu s^2)) + d log s^2 ] + c
// (Lange, Little and Taylor 1989). A pose far off costs the logarithm of its
// distance: a model that explains it is better than one that gives it up.
struct StudentFit {
  double scale = 0;         // s, maximising the likelihood
  double deviance = 0;      // -2 log p
  Eigen::VectorXd weights;  // per pose, (nu + d) / (nu + |r_k|^2 / s^2)
};

// nu: degrees of freedom, infinite: normal errors.
StudentFit FitStudent(const Eigen::VectorXd& r, int width, double nu);

// Of the estimates' covariance over s^2 (J'WJ)^-1, for independent errors of
// this kind (Huber 1981, 7.6) and so many unknowns.
double StudentVarianceFactor(const Eigen::VectorXd& r, int width, double nu,
                             const StudentFit& fit, double unknowns);

}  // namespace armcal
