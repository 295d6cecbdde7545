#pragma once

#include <Eigen/Core>

#include "calib/poses/effects/campaign.h"

namespace armcal {

// What of an arm's posture a displacement goes with: a number at each pose,
// which a campaign's poses give here and the joints' positions give a
// controller (poses/correction).
struct PostureSignal {
  enum class Of {
    kNothing,       // of the posture: of the order of poses
    kOne,           // 1 at each pose
    kPosition,      // a joint's position as it was recorded, rad or m
    kSine,          // of `harmonic` times the angle at which the joint stands
    kCosine,        // the same
    kToolMoment,    // about the joint, of a unit weight at the tool, m
    kLinkMoment,    // of one spread over the origins of the further links, m
    kWeightMoment,  // of an arm that was weighed, of its weight, N m
    kLoadSide,      // the sign of kToolMoment
    kBaseMoment,    // of the weight at the tool, about an axis of the base, m
    kToolGravity,   // gravity's direction along an axis of the tool
  };
  Of of = Of::kNothing;
  int index = 0;  // the joint, or the axis: 0 to 2
  double harmonic = 1;
};

// At each pose of a campaign. CHECK-fails for kNothing.
Eigen::VectorXd SignalAt(const PoseCampaign& campaign,
                         const PostureSignal& signal);

}  // namespace armcal
