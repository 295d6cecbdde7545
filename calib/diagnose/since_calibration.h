#pragma once

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// Diagnoses the gap between a calibrated robot and logs, given the logs that it
// was calibrated on (`own`), which tell two questions apart:
//   - What has changed since? Asked with the own logs as the reference, so that
//     what they show besides the model is no change. What is named, or one of
//     a few, is the answer.
//   - Else: what does the model lack? Effects that the diagnosed logs ask for,
//     if the own logs have them at that size, too.
// The latter is a claim that a second log of the robot confirms; the former is
// none about what the model lacks. `options` hold the calibration's
// posterior; that of a reference, `trust_beside_own`, replaces it in the first
// question, since its logs are fitted there and would count twice.
GapDiagnosis DiagnoseSinceCalibration(const Robot& calibrated,
                                      const DiagnosisOptions& options,
                                      double trust_beside_own,
                                      const LogSet& training,
                                      const LogSet* validation,
                                      const LogSet& own);

// Whether a diagnosis names something, or tells it as one of a few that data
// cannot tell apart.
bool TellsOfAChange(const GapDiagnosis& changed);

}  // namespace armcal
