#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/diagnose/diagnosis.h"

namespace armcal {

// Verdict, where, which, how far; for a terminal. `verbose`: with the list of
// what is not testable, however long.
std::string FullReport(const GapDiagnosis& diagnosis, bool verbose);
// diagnosis.json (docs/diagnose.md).
nlohmann::json ToJson(const GapDiagnosis& diagnosis);

}  // namespace armcal
