#pragma once

#include <Eigen/Core>

namespace armcal {

inline constexpr double kStandstillSpeed = 1e-3;  // rad/s or m/s
inline constexpr double kStandstillTime = 0.5;    // s
// rad or m. How far a joint moves from rest before its bearings slide all over:
// the smallest that the effect `presliding` is looked for with, which is what
// moves farther on bristles than this.
inline constexpr double kPreslidingDisplacement = 3e-3;
inline constexpr double kStandstillMeanTime = 0.2;  // s, of judged velocities

// Mean velocity over kStandstillMeanTime around each sample (less at the ends).
Eigen::MatrixXd MeanVelocity(const Eigen::MatrixXd& q, double dt);

// Samples at which all |velocity| stay below `speed` for kStandstillTime or
// longer. `reach`: how many samples on each side of its own a velocity stands
// for.
Eigen::Array<bool, Eigen::Dynamic, 1> FindStandstill(
    const Eigen::MatrixXd& velocity, double dt, int reach,
    double speed = kStandstillSpeed);

}  // namespace armcal
