#pragma once

#include <string>
#include <vector>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"
#include "tools/flag_values.h"

namespace armcal {

// The measured poses of --poses, of images by way of --camera and --camera_on.
// Throws InputError, UsageError.
PoseMeasurements PosesFromFlags(const FlagValues& flags, const Robot& robot);
// Files of --camera, one for each camera; none where it says estimate alone.
std::vector<std::string> CameraFiles(const FlagValues& flags);
// Those of another file, by the same camera.
PoseMeasurements PosesFromFile(const FlagValues& flags, const Robot& robot,
                               const std::string& file);

}  // namespace armcal
