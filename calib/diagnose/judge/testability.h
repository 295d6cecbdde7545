#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/judge/found_effect.h"
#include "calib/diagnose/select/fit.h"

namespace armcal {

struct UntestableEffect {
  std::string effect;
  std::string joint;  // empty: the whole robot
  std::string why;
};

// Effects that these data say nothing of: that the robot cannot show, that the
// model's own parameters would take for theirs, or that would hide in the noise
// at a size that matters. Those that were `found` are larger than that, and are
// not among them.
std::vector<UntestableEffect> ListUntestable(
    const GapFit& fit, const std::vector<FoundEffect>& found);

}  // namespace armcal
