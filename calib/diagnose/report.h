#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// The sentence a colleague would want to read.
std::string BriefReport(const GapDiagnosis& diagnosis);
// Verdict, where, which, how far; for a terminal.
std::string FullReport(const GapDiagnosis& diagnosis);
// diagnosis.json (docs/diagnose.md).
nlohmann::json ToJson(const GapDiagnosis& diagnosis);

}  // namespace armcal
