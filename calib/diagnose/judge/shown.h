#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/select/fit.h"

namespace armcal {

// An effect that the robot had before: the reference itself shows it.
struct ShownEffect {
  const Effect* effect = nullptr;
  int joint = -1;  // from 0; -1: the whole robot
  std::vector<EffectEstimate> estimates;
  std::vector<double> stddev;  // of these, their shapes being given
  // Whether its sizes, all together, differ from 0 at the 5 % level (Wald's
  // test). A law that helps to predict the reference may be small, or share its
  // torque with others in ways that no log tells.
  bool is_significant = true;
};

// Whether estimates differ from 0 at the 5 % level: Wald's test, in the
// directions in which they have a variance.
bool AreSignificant(const Eigen::VectorXd& p,
                    const Eigen::MatrixXd& covariance);

// Those that the fit's baseline knows, as the reference alone has them: what
// it shows does not depend on the logs that are compared with it.
std::vector<ShownEffect> ListShown(const GapFit& fit);

}  // namespace armcal
