#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "calib/diagnose/changes/changes.h"

namespace armcal {

// "From log to log: friction of joint2 changed at log 8." Empty where nothing
// changed or it could not be told.
std::string BriefChanges(const LogChanges& changes);
// The section of a report for a terminal.
std::string FullChanges(const LogChanges& changes);
// `changes` of diagnosis.json (docs/diagnose.md).
nlohmann::json ToJson(const LogChanges& changes);

}  // namespace armcal
