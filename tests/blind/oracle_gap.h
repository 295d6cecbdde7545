#pragma once

#include <Eigen/Core>
#include <optional>

#include "tests/blind/effect_size.h"

namespace armcal {

// How far the gap on the validation log can shrink: mean squares per joint,
// (N m)^2 or N^2, of noiseless residuals at 25 Hz below 10 Hz.
struct OracleGap {
  Eigen::VectorXd nominal;  // of the robot file
  // With what the model may vary fitted to the training log within its prior
  // (and what a reference log tells).
  Eigen::VectorXd refit;
  // The same fitted to the robot without its effects, which one who knew them
  // exactly would be left with.
  Eigen::VectorXd after;
  Eigen::VectorXd floor;  // of the noise, to be added to each of these

  // 100 (refit - after) / refit and 100 (nominal - after) / nominal, each joint
  // in units of its floor.
  double RemovedPercent() const;
  double RemovedFromNominalPercent() const;
};

// Nothing where the arm does not follow its motion.
std::optional<OracleGap> FindOracleGap(const BlindCase& blind,
                                       EffectSizer* sizer);

}  // namespace armcal
