#pragma once

#include "calib/refine/arm_trust.h"
#include "tools/flag_values.h"

namespace armcal {

// --trust --length_trust --angle_trust. Throws UsageError.
ArmTrust TrustFromFlags(const FlagValues& flags);

}  // namespace armcal
