#pragma once

#include "calib/inspect/reading_state.h"

namespace armcal {

// Gravity the other way round, where the file's own bodies say so.
void TurnGravity(ReadingState* state);

// Gravity tilted about the world's horizontal axes, by ever smaller steps, to
// where torques fit best; of less than 5 degrees nothing is said.
void RefineGravity(ReadingState* state);

}  // namespace armcal
