#pragma once

#include <string>
#include <vector>

#include "calib/robot_source.h"
#include "calib/summary.h"
#include "model/robot/robot.h"
#include "model/text/progress.h"

namespace armcal {

struct MergeOptions {
  // Of the robot; its sha256, where it is there, has to be that of the factor
  // files.
  RobotSource source;
  Progress progress;
};

struct MergeSummary : Summary {
  bool solved = false;
};

// A calibration from factor files of armcal reduce, or folders of them, and
// what the units of one robot have in common, differ in and drift by. Throws
// InputError.
MergeSummary Merge(const Robot& robot, const std::vector<std::string>& factors,
                   const MergeOptions& options);

}  // namespace armcal
