#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/poses/diagnosis/model.h"

namespace armcal {

inline constexpr int kPoseFolds = 6;  // as calibrate's

// Fold of each row: every sixth pose, or six stretches of the order.
std::vector<int> EverySixthPose(const PoseStudy& study);
std::vector<int> SixStretches(const PoseStudy& study);

// Residuals of each pose, predicted by a model with all its places that was
// fitted to the poses of other folds: one step of Gauss and Newton from the fit
// to all, and what is left is calculated anew there.
Eigen::VectorXd HeldOutResiduals(const PoseStudy& study, const PoseModel& model,
                                 const std::vector<int>& folds);

// Root of the mean square of distances: of each target, pose or wire, m.
double RmsDistance(const PoseStudy& study, const Eigen::VectorXd& residuals);

// -2 log p of each pose's held-out residuals at the model's own scale.
Eigen::VectorXd HeldOutDeviance(const PoseStudy& study, const PoseModel& model,
                                const Eigen::VectorXd& residuals);

// What held-out poses say of a model against a smaller one.
struct HeldOutGain {
  double deviance = 0;  // by how much -2 log p falls
  double stddev = 0;    // of that, from its scatter over the poses
  // Of the mean square of positions or lengths, and of rotations beside them.
  double removed_share = 0;
  // Clearly likelier, and no further from what was measured.
  bool IsClear() const;
};
HeldOutGain CompareHeldOut(const PoseStudy& study, const PoseModel& without,
                           const PoseModel& with,
                           const std::vector<int>& folds);

}  // namespace armcal
