#pragma once

#include "model/robot/robot.h"
#include "model/robot_tree/robot_reader_options.h"
#include "model/text/document.h"

namespace armcal {

// Reads the chain base..tip of a URDF file, see MakeTreeRobot. Strict: every
// number must be one ("2kg", "nan", "1,5" are refused with line and attribute);
// DOCTYPE, loops, two parents, unknown joint types, non-finite or negative
// masses, zero axes, swapped limits, unexpanded xacro, duplicate names are
// refused; of links and joints outside the chain what is wrong is noted.
// Accepted with a note: mass 0 (no inertia given), inertia that no rigid body
// has (a start value), limits that are missing or 0 (none). No entity, mesh or
// other file is ever opened. Throws InputError.
Robot ReadUrdf(const Document& file, const RobotReaderOptions& options);

}  // namespace armcal
