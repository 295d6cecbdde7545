#pragma once

#include <string>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "tools/flag_values.h"

namespace armcal {

// The measured poses of --poses, of images by way of --camera and --camera_on.
// Throws InputError, UsageError.
PoseMeasurements PosesFromFlags(const FlagValues& flags, const Robot& robot);
// Those of another file, by the same camera.
PoseMeasurements PosesFromFile(const FlagValues& flags, const Robot& robot,
                               const std::string& file);

}  // namespace armcal
