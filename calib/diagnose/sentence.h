#pragma once

#include <string>

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// The sentence a colleague would want to read.
std::string BriefReport(const GapDiagnosis& diagnosis);

}  // namespace armcal
