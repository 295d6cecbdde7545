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
};

// Those that the fit's baseline knows, at its values x.
std::vector<ShownEffect> ListShown(const GapFit& fit, const Eigen::VectorXd& x);

}  // namespace armcal
