#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/diagnosis/model.h"

namespace armcal {

// One more effect, to first order.
struct ScannedEffect {
  PlacedPoseEffect placed;
  Eigen::VectorXd amounts;
  double score;  // by how much EvidenceOf() would change; below 0: for it
};

// The best places of every effect that `model` does not have, best first; to
// each pose its weight in the model, or to all the same: an effect that few
// poses show is not seen with theirs.
std::vector<ScannedEffect> ScanEffects(const PoseStudy& study,
                                       const PoseModel& model,
                                       bool equal_weights);

}  // namespace armcal
