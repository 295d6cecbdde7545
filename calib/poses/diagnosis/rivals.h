#pragma once

#include <vector>

#include "calib/poses/diagnosis/model.h"

namespace armcal {

// What could stand in the place of an effect of a model.
struct PoseRival {
  PlacedPoseEffect placed;
  double weight = 0;  // evidence over that of the effect itself
  PoseModel model;    // with it instead
};

struct PoseRivals {
  double probability = 0;         // of the effect, beside its rivals and none
  double none = 0;                // that there is no effect
  std::vector<PoseRival> rivals;  // best first
  PoseModel without;              // the model without the effect
};

// `design_effect`: of the model.
PoseRivals FindRivals(const PoseStudy& study, const PoseModel& model,
                      size_t effect, double design_effect);

}  // namespace armcal
