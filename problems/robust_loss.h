#pragma once

#include <ceres/loss_function.h>

namespace armcal {

// What large residuals count, of torques and of poses alike. Huber's lets each
// pull with a bounded force, Cauchy's with a falling one, Tukey's gives up
// those beyond its scale.
enum class RobustLoss { kSquared, kHuber, kCauchy, kTukey };

// "squared", "huber", "cauchy", "tukey".
const char* LossName(RobustLoss loss);
// In noise units, for residuals of 1, 2, 3 or 6 coordinates that are judged by
// their length: 95 % efficient for normal errors (one coordinate: Holland and
// Welsch 1977; the others by the same integral). 0 for kSquared.
double LossScale(RobustLoss loss, int coordinates = 1);
// At LossScale(); null for kSquared.
ceres::LossFunction* MakeLoss(RobustLoss loss, int coordinates);

// Of one residual of r standard deviations: its factor in the normal equations,
// psi(r) / r, and the derivative of its score psi.
struct LossAt {
  double weight;
  double slope;
};
LossAt EvaluateLoss(RobustLoss loss, double r);

}  // namespace armcal
