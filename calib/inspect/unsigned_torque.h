#pragma once

#include <vector>

#include "calib/logs/wiring.h"
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

}  // namespace armcal
