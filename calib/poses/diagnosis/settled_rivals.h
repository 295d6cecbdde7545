#pragma once

#include <vector>

#include "calib/poses/diagnosis/finding.h"
#include "calib/poses/diagnosis/rivals.h"

namespace armcal {

// Which effect none is likelier than: the one beside which that there is none
// is likeliest; -1 where each is likelier, by its name or as one of a few.
int LeastClaimed(const std::vector<PoseRivals>& rivals);

// Rivals of each effect of *model, which changes until it has what is claimed:
// a rival that is likelier than an effect, and that held-out poses confirm,
// takes its place, and what none is likelier than goes, to *unlikely. The
// design effect is then that of the model.
std::vector<PoseRivals> SettleRivals(const PoseStudy& study, PoseModel* model,
                                     double* design_effect,
                                     std::vector<UnlikelyPoseEffect>* unlikely);

}  // namespace armcal
