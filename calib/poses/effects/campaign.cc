#include "calib/poses/effects/campaign.h"

#include "calib/logs/encoder_noise.h"
#include "calib/poses/load_moment.h"
#include "calib/poses/pose_label.h"
#include "model/dynamics/forward_dynamics.h"
#include "model/robot/kinematics.h"

namespace armcal {

using Eigen::Isometry3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

// LoadMoments() of a weight that is shared by the origins of all further links:
// where an arm's own mass lies is not known, but nearer than its tool.
MatrixXd OwnMoments(const Robot& robot, const MatrixXd& q) {
  const Vector3d down = robot.gravity.stableNormalized();
  MatrixXd moments = MatrixXd::Zero(q.rows(), q.cols());
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    const std::vector<Isometry3d> X_WL = LinkPoses(robot, q.row(k).transpose());
    Isometry3d X_WP = Isometry3d::Identity();
    for (int i = 0; i < robot.num_joints(); ++i) {
      const Isometry3d X_WF = X_WP * robot.links[i].X_PF;
      X_WP = X_WL[i];
      if (!IsRotational(robot.links[i].joint.type)) continue;
      Vector3d lever = Vector3d::Zero();
      for (size_t l = i + 1; l < X_WL.size(); ++l) {
        const Vector3d p_WF = (X_WL[l - 1] * robot.links[l].X_PF).translation();
        lever += (p_WF - X_WF.translation()) / (X_WL.size() - i);
      }
      moments(k, i) = X_WF.linear().col(2).dot(lever.cross(down));
    }
  }
  return moments;
}

// Of what the links weigh: what joints hold, the other way round. A prismatic
// joint does not turn.
MatrixXd WeightMoments(const Robot& robot, const MatrixXd& q) {
  MatrixXd moments(q.rows(), q.cols());
  for (Eigen::Index k = 0; k < q.rows(); ++k) {
    moments.row(k) = -GravityTorque(robot, q.row(k).transpose()).transpose();
  }
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (!IsRotational(robot.links[i].joint.type)) moments.col(i).setZero();
  }
  return moments;
}

}  // namespace

bool PoseCampaign::Moves(int joint) const {
  return travel[joint] > kLeastTravel;
}

bool PoseCampaign::Turns(int joint) const {
  return Moves(joint) && IsRotational(robot().links[joint].joint.type);
}

PoseCampaign MakeCampaign(const KnownArm& arm, const PoseMeasurements& measured,
                          const MatrixXd& by_file,
                          const Eigen::VectorXd& zeros) {
  PoseCampaign campaign;
  const Robot& robot = arm.robot;
  campaign.arm = arm;
  campaign.recorded = measured.q;
  campaign.zeros = zeros;
  if (zeros.size() == 0) campaign.zeros.setZero(robot.num_joints());
  const MatrixXd standing = by_file.rowwise() + campaign.zeros.transpose();
  campaign.standing = standing;
  campaign.travel =
      measured.q.colwise().maxCoeff() - measured.q.colwise().minCoeff();
  campaign.tool_moment = LoadMoments(robot, standing);
  campaign.link_moment = OwnMoments(robot, standing);
  if (arm.weighed) campaign.weight_moment = WeightMoments(robot, standing);
  campaign.word = PoseWord(measured);
  for (int k = 0; k < measured.size(); ++k) {
    campaign.number.push_back(PoseLabel(measured, k));
  }
  campaign.targets = static_cast<int>(measured.targets.size());
  campaign.whole_poses = measured.poses.size() > 0;
  campaign.wire = measured.lengths.size() > 0;
  return campaign;
}

}  // namespace armcal
