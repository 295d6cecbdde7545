#include "calib/poses/effects/posture_signal.h"

#include <glog/logging.h>

#include "model/robot/kinematics.h"

namespace armcal {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

// Of each pose of the tool as the joints stand.
template <typename OfPose>
VectorXd OfTool(const PoseCampaign& campaign, const OfPose& of_pose) {
  const Vector3d down = campaign.robot().gravity.stableNormalized();
  VectorXd values(campaign.size());
  for (int k = 0; k < campaign.size(); ++k) {
    const VectorXd q = campaign.standing.row(k);
    values[k] = of_pose(ToolPose(campaign.robot(), q), down);
  }
  return values;
}

}  // namespace

VectorXd SignalAt(const PoseCampaign& campaign, const PostureSignal& signal) {
  using Of = PostureSignal::Of;
  const int i = signal.index;
  switch (signal.of) {
    case Of::kOne:
      return VectorXd::Ones(campaign.size());
    case Of::kPosition:
      return campaign.recorded.col(i);
    case Of::kSine:
      return (signal.harmonic * campaign.standing.col(i).array()).sin();
    case Of::kCosine:
      return (signal.harmonic * campaign.standing.col(i).array()).cos();
    case Of::kToolMoment:
      return campaign.tool_moment.col(i);
    case Of::kLinkMoment:
      return campaign.link_moment.col(i);
    case Of::kWeightMoment:
      return campaign.weight_moment.col(i);
    case Of::kLoadSide:
      return campaign.tool_moment.col(i).array().sign();
    case Of::kBaseMoment:
      return OfTool(campaign, [i](const auto& X_WT, const Vector3d& down) {
        return Vector3d(X_WT.translation()).cross(down)[i];
      });
    case Of::kToolGravity:
      return OfTool(campaign, [i](const auto& X_WT, const Vector3d& down) {
        return X_WT.linear().col(i).dot(down);
      });
    case Of::kNothing:
      break;
  }
  LOG(FATAL) << "the order of poses is no part of a posture";
  return {};
}

}  // namespace armcal
