#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "calib/poses/correction/actual_arm.h"

namespace armcal {

// Joint positions at which `pose` (of joint positions) is closest to `wanted`,
// from q on: least squares of position (m) and kCorrectionLever times the angle
// (rad), by damped Gauss-Newton steps, of which the nearest is kept: where an
// arm is singular or out of reach they lead anywhere. An arm of six joints and
// more meets both elsewhere.
using PoseOfJoints = std::function<Eigen::Isometry3d(const Eigen::VectorXd&)>;
Eigen::VectorXd NearestPosture(const PoseOfJoints& pose,
                               const Eigen::Isometry3d& wanted,
                               const Eigen::VectorXd& q);

// m: what an angle counts, the length of a tool.
inline constexpr double kCorrectionLever = .1;
// Steps, and their damping in m: below the lever of a joint by a hundred, so
// that a step leaves 1e-4 of the error in regular postures.
inline constexpr int kCorrectionSteps = 8;
inline constexpr double kCorrectionDamping = 1e-3;
// rad or m: of the difference that gives a derivative, and the step that is
// the last one.
inline constexpr double kCorrectionDifference = 1e-6;
inline constexpr double kCorrectionSettled = 1e-10;

// What to add to recorded joint positions so that the robot file's kinematics
// give where the tool is.
Eigen::VectorXd ForwardCorrection(const ActualArm& arm,
                                  const Eigen::VectorXd& q);
// What to add to joint positions that a controller has from the robot file's
// kinematics so that the tool gets where these say.
Eigen::VectorXd CommandCorrection(const ActualArm& arm,
                                  const Eigen::VectorXd& q);

}  // namespace armcal
