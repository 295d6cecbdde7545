#include "calib/poses/correction/joint_correction.h"

#include <Eigen/Cholesky>
#include <limits>

#include "model/robot/kinematics.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d Away(const Isometry3d& from, const Isometry3d& to) {
  const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
  Vector6d away;
  away << to.translation() - from.translation(),
      kCorrectionLever * turn.angle() * turn.axis();
  return away;
}

}  // namespace

VectorXd NearestPosture(const PoseOfJoints& pose, const Isometry3d& wanted,
                        const VectorXd& q0) {
  VectorXd q = q0, nearest = q0;
  double least = std::numeric_limits<double>::infinity();
  MatrixXd J(6, q.size());
  for (int step = 0; step <= kCorrectionSteps; ++step) {
    const Isometry3d X = pose(q);
    const Vector6d away = Away(X, wanted);
    if (away.norm() < least) {
      least = away.norm();
      nearest = q;
    }
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      VectorXd other = q;
      other[i] += kCorrectionDifference;
      J.col(i) = Away(X, pose(other)) / kCorrectionDifference;
    }
    MatrixXd A = J.transpose() * J;
    A.diagonal().array() += kCorrectionDamping * kCorrectionDamping;
    const VectorXd by = A.ldlt().solve(J.transpose() * away);
    if (by.cwiseAbs().maxCoeff() < kCorrectionSettled) break;
    q += by;
  }
  return nearest;
}

VectorXd ForwardCorrection(const ActualArm& arm, const VectorXd& q) {
  const auto by_file = [&](const VectorXd& at) {
    return ToolPose(arm.file(), at);
  };
  return NearestPosture(by_file, arm.ToolPose(q), q) - q;
}

VectorXd CommandCorrection(const ActualArm& arm, const VectorXd& q) {
  const auto actual = [&](const VectorXd& at) { return arm.ToolPose(at); };
  return NearestPosture(actual, ToolPose(arm.file(), q), q) - q;
}

}  // namespace armcal
