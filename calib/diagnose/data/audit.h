#pragma once

#include <string>
#include <vector>

#include "calib/diagnose/data/rows.h"
#include "model/effects/effect.h"
#include "model/robot/robot.h"

namespace armcal {

// Something about the data that a diagnosis depends on.
struct DataFinding {
  std::string finding;
  std::string evidence;
  std::string flag;       // what to change, or empty
  bool leads = false;     // the diagnosis begins with it
  bool is_doubt = false;  // what it says may be otherwise: the rest goes on
};

// Whether a diagnosis goes on with all of these, or there are none.
bool AreDoubts(const std::vector<DataFinding>& findings);

// Whether the recorded torque was computed from the recorded positions, as a
// gravity compensation's command is: then it follows a static law of position
// to a tenth of what it takes at least to accelerate the arm as recorded, which
// measured torque cannot. Empty where it was not, or where nothing tells: no
// masses, hardly any acceleration.
std::vector<DataFinding> AuditTorque(const Robot& robot, const GapRows& rows);

// Of wrong samples of positions that were left out.
std::vector<DataFinding> TellPositionSpikes(
    const Robot& robot, const std::vector<GapSegment>& segments);

// Of logs that have no rows in any fold (LogPart): how long a stretch of log
// would have some.
DataFinding TooShortToHoldOut(const GapRows& rows);

// Of joint terms that a reference has otherwise, on many joints: it is believed
// on the links alone.
DataFinding OtherThanReference(const std::vector<const Effect*>& terms);

}  // namespace armcal
