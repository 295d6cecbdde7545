#pragma once

#include <vector>

#include "calib/poses/diagnosis/model.h"

namespace armcal {

// Models of the poses, best first by their evidence at the design effect of the
// best: all that a search has fitted.
struct PoseSelection {
  std::vector<PoseModel> models;
  std::vector<double> evidence;  // of each, EvidenceOf()
  double design_effect = 1;
};

// Looks for the effects that explain what `alone`, the geometry, leaves.
// Effects that look like a smear of each other by themselves are found
// together: from each of the best models so far the search goes on.
PoseSelection SelectEffects(const PoseStudy& study, const PoseModel& alone);

}  // namespace armcal
