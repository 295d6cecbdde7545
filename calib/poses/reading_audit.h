#pragma once

#include <string>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// Whether a joint that counts the other way is a mistake of the file, or what
// is looked for.
enum class TurnedJoints { kAreMistakes, kAreFindings };

// Says how poses were meant (PoseReadings) that the robot's geometry explains
// far better so than as they were read, and what the file has to have. Empty
// where none of these readings makes them follow.
std::string WrongReading(const Robot& robot, const PoseMeasurements& measured,
                         TurnedJoints turned = TurnedJoints::kAreMistakes);

// Throws OptionError of the option that names the poses where it says so.
void RequireReading(const Robot& robot, const PoseMeasurements& measured,
                    const char* option,
                    TurnedJoints turned = TurnedJoints::kAreMistakes);

}  // namespace armcal
