#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/robot/inertial_parameters.h"

namespace armcal {

// How an entry of a robot's joint terms may move.
enum class TermRange { kFree, kPositive, kHeld };

// The minimum of
//   |R x - z|^2 + 2 / trust^2 sum_i (tr X_i - log det X_i - 4),
// x = [V_1 .. V_n, joint terms], P(V_i) = A_i X_i A_i', A_i A_i' = P(V_0i),
// over bodies that can exist and terms in their ranges: the problem of
// CalibrateNonlinear, but in V, where it is convex. An interior-point method
// (Newton; the links of the file are trusted less and less) that solves it from
// any start, also where logs pull links to the boundary; positive terms stay a
// ten thousandth of a standard deviation clear of 0, held ones are as they
// were, exactly. `x` holds the terms' start values; its links and V_0 are those
// of the file, inside the boundary. Nothing where numbers overflow.
std::optional<Eigen::VectorXd> StartLinks(const Eigen::MatrixXd& R,
                                          const Eigen::VectorXd& z,
                                          double trust,
                                          const std::vector<TermRange>& terms,
                                          const Eigen::VectorXd& x);

}  // namespace armcal
