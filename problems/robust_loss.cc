#include "problems/robust_loss.h"

#include <glog/logging.h>

namespace armcal {
namespace {

// Ceres writes a loss as rho(s) with s = r^2, of which half is the cost. Its
// derivative by r is the score psi = r rho'(s); hence the weight psi / r = rho'
// and the slope psi' = rho' + 2 s rho''. The slope of Tukey's and Cauchy's
// losses is negative for large residuals: covariances want it so, while
// iterations go by the weight, which is never negative.
LossAt FromCeres(const ceres::LossFunction& loss, double r) {
  double rho[3];
  loss.Evaluate(r * r, rho);
  return {rho[1], rho[1] + 2 * r * r * rho[2]};
}

}  // namespace

const char* LossName(RobustLoss loss) {
  switch (loss) {
    case RobustLoss::kSquared:
      return "squared";
    case RobustLoss::kHuber:
      return "huber";
    case RobustLoss::kCauchy:
      return "cauchy";
    case RobustLoss::kTukey:
      return "tukey";
  }
  return "";
}

// Scales at which the estimate of a mean has 1 / .95 of the least variance if
// errors are normal after all: (E psi')^2 / E psi^2 = .95. For one coordinate
// they are the well-known 1.345 of Huber's loss and 4.685 of Tukey's (Holland
// and Welsch 1977). The length of several normal coordinates is larger (chi),
// and so are the scales.
double LossScale(RobustLoss loss, int coordinates) {
  const int column = coordinates <= 3 ? coordinates - 1 : 3;
  CHECK(column < 3 || coordinates == 6) << coordinates;
  constexpr double kHuber[] = {1.345, 1.500, 1.628, 1.869};
  constexpr double kCauchy[] = {2.385, 2.545, 2.666, 2.862};
  constexpr double kTukey[] = {4.685, 5.120, 5.490, 6.356};
  switch (loss) {
    case RobustLoss::kSquared:
      return 0;
    case RobustLoss::kHuber:
      return kHuber[column];
    case RobustLoss::kCauchy:
      return kCauchy[column];
    case RobustLoss::kTukey:
      return kTukey[column];
  }
  return 0;
}

ceres::LossFunction* MakeLoss(RobustLoss loss, int coordinates) {
  const double scale = LossScale(loss, coordinates);
  switch (loss) {
    case RobustLoss::kSquared:
      return nullptr;
    case RobustLoss::kHuber:
      return new ceres::HuberLoss(scale);
    case RobustLoss::kCauchy:
      return new ceres::CauchyLoss(scale);
    case RobustLoss::kTukey:
      return new ceres::TukeyLoss(scale);
  }
  return nullptr;
}

LossAt EvaluateLoss(RobustLoss loss, double r) {
  switch (loss) {
    case RobustLoss::kSquared:
      return {1, 1};
    case RobustLoss::kHuber:
      return FromCeres(ceres::HuberLoss(LossScale(loss)), r);
    case RobustLoss::kCauchy:
      return FromCeres(ceres::CauchyLoss(LossScale(loss)), r);
    case RobustLoss::kTukey:
      return FromCeres(ceres::TukeyLoss(LossScale(loss)), r);
  }
  return {1, 1};
}

}  // namespace armcal
