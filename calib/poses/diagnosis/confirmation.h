#pragma once

#include "calib/poses/diagnosis/selection.h"

namespace armcal {

// `model` without the effects that held-out poses do not confirm beside its
// others, the least confirmed first.
PoseModel ConfirmedPart(const PoseStudy& study, PoseModel model);

// The likeliest of the confirmed parts of a selection's models.
PoseModel ConfirmedModel(const PoseStudy& study,
                         const PoseSelection& selection);

}  // namespace armcal
