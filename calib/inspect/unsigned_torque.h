#pragma once

#include <vector>

#include "calib/logs/inspection_finding.h"
#include "calib/logs/uniform_series.h"
#include "calib/logs/wiring.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// A joint whose torque is logged without its sign, as drives that report a load
// do.
struct UnsignedTorque {
  int joint = 0;
  double before = 0, after = 0;  // %, what a fit leaves of it held out, with
                                 // the sign as logged and with that of the fit
  double turned = 0;             // share of samples whose sign the fit changes
};

// Of a torque that is never negative, or never positive, it is asked whether an
// arm whose torque has both signs explains its size better than it explains the
// torque as it is: |tau_fit| against |tau|, by fits whose signs and parameters
// are found in turn and judged on samples that they have not seen.
// `joints` are those that are asked about: whose torque, as it was logged, has
// one sign.
std::vector<UnsignedTorque> FindUnsignedTorques(const Robot& robot,
                                                const WiringSamples& samples,
                                                const std::vector<int>& joints);

// These, and those of the joints asked about whose torque in the log comes near
// zero and leaves again as what goes through zero does (FindFolds): of friction
// and short motions a fit that may choose the signs explains the size either
// way, and this asks no model.
std::vector<InspectionFinding> UnsignedFindings(const Robot& robot,
                                                const UniformSeries& series,
                                                const Log& log,
                                                const WiringSamples& samples,
                                                const std::vector<int>& joints);

}  // namespace armcal
