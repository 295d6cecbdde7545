#pragma once

#include <optional>
#include <vector>

#include "model/dynamics/joint_term.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct RolloutOptions {
  std::vector<double> windows_s = {0.2, 0.5, 1};
  // To which windows are simulated, rad (m), and 100 times that in rad/s (m/s).
  double tolerance = 1e-5;
  // How long Simbody may simulate windows, s by the clock; each length has one
  // in each log however short that is. Infinite: all of them;
  // none: no window is simulated in Simbody.
  std::optional<double> simbody_s;
  Progress progress;
};

// A robot that is simulated, and how the Coulomb friction of each of its joints
// changes sign.
struct RolloutModel {
  Robot robot;
  std::vector<CoulombTransition> transitions;
};

}  // namespace armcal
