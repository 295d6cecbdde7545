#pragma once

#include "tools/command.h"

namespace armcal {

// Whether --poses asks for a diagnosis of the geometry.
bool DiagnosesPoses(const CommandInput& input);
CommandOutcome RunDiagnosePoses(const CommandInput& input);

}  // namespace armcal
