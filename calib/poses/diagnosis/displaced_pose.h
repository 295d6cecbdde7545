#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "calib/poses/effects/effect.h"
#include "model/robot/arm_geometry.h"
#include "problems/poses/pose_problem.h"

namespace armcal {

// All that terms can move, a number each: joints, the base's three rotations,
// the tool's and the frame's six motions, the scale, the length, and three
// motions of each target.
class PoseMovers {
 public:
  PoseMovers(int joints, int targets) : joints_(joints), targets_(targets) {}
  int size() const { return joints_ + 17 + 3 * targets_; }
  int joints() const { return joints_; }
  int targets() const { return targets_; }
  int Index(PoseTerm::Acts acts, int index) const;

 private:
  int joints_, targets_;
};

// An arm in one pose, with what `by`, an amount for each mover, displaces.
struct DisplacedPose {
  Eigen::VectorXd q;
  Eigen::Isometry3d moved;   // frame and base, in the instrument's frame
  double scale;              // of distances from the base
  Eigen::Vector3d base;      // the base's origin
  Eigen::Isometry3d X_WT;    // by the geometry alone
  Eigen::Isometry3d X_TB;    // the tool's body on the tool
  Eigen::Matrix3Xd on_tool;  // the targets in the tool's body
  Eigen::Matrix3Xd points;   // where they are
  Eigen::Matrix3d R;         // how the body is turned
  double length;             // added to a wire's
  // Of the geometry's parameters and of the joints, at X_WT; empty where they
  // are not asked for.
  std::vector<ParameterTwist> parameters, joints;

  DisplacedPose(const ArmGeometry& geometry, const PoseMovers& movers,
                const PoseUnknowns& unknowns, const Eigen::VectorXd& q,
                const Eigen::VectorXd& by, const Eigen::Vector3d& middle,
                bool with_twists);

  // d points and the angular velocity of the body by a parameter of the
  // geometry or a joint, whose twists are those of X_WT.
  Eigen::Vector3d ByTwist(const ParameterTwist& twist,
                          Eigen::Matrix3Xd* velocity) const;
  // By mover k; not of the length, which moves none.
  Eigen::Vector3d ByMover(const PoseMovers& movers,
                          const PoseUnknowns& unknowns, int k,
                          const Eigen::Vector3d& middle,
                          Eigen::Matrix3Xd* velocity) const;
};

// The base's pose in the instrument's frame, the first six of a geometry.
Eigen::Isometry3d BasePose(const Eigen::VectorXd& geometry);

// Rotation vector of R.
Eigen::Vector3d RotationVector(const Eigen::Matrix3d& R);

}  // namespace armcal
