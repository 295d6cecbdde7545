#include "calib/poses/effects/effect.h"
#include "model/robot/kinematics.h"

namespace armcal {

// What carries the target gives way along the tool's x and y axes in proportion
// to the component of gravity there, and by so much less along z: giving way
// alike along all three is the same displacement in all poses.
PoseEffect ToolSag() {
  PoseEffect effect;
  effect.name = "tool_sag";
  effect.means = "what carries the target bends under its weight";
  effect.separate_by = "the wrist turned at the same place of the tool";
  effect.places = [](const PoseCampaign&) {
    return std::vector<PosePlace>{{}};
  };
  effect.terms = [](const PoseCampaign& campaign, const PosePlace&) {
    const Eigen::Vector3d down = campaign.robot.gravity.stableNormalized();
    Eigen::MatrixXd component(campaign.size(), 3);
    for (int k = 0; k < campaign.size(); ++k) {
      const Eigen::VectorXd q = campaign.standing.row(k);
      component.row(k) =
          (ToolPose(campaign.robot, q).linear().transpose() * down).transpose();
    }
    std::vector<PoseTerm> terms;
    for (int axis = 0; axis < 2; ++axis) {
      terms.push_back({PoseTerm::Acts::kTool, axis, component.col(axis),
                       std::string(1, "xyz"[axis]), "m"});
    }
    return terms;
  };
  return effect;
}

}  // namespace armcal
