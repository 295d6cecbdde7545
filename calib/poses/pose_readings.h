#pragma once

#include <functional>
#include <string>
#include <vector>

#include "model/log_files/pose_reader.h"
#include "model/robot/robot.h"

namespace armcal {

// Another way in which a file of poses may have been meant than it was read.
struct PoseReading {
  // What the file holds then and what it has to have instead: "joint positions
  // are degrees that were read as radians: expected names that end with [deg]".
  std::string meant;
  std::function<void(PoseMeasurements*)> apply;
  // Whose positions it changes: a wrong zero of theirs must not speak for it.
  std::vector<int> joints;
  bool turns_joint_round = false;
};

// Degrees and millimetres (and their reverse), a left-handed frame, the pose of
// the base in the tool, quaternions in another order or of the inverse
// rotation, two columns of joints exchanged, a joint that counts the other way:
// one mistake at a time, but for units, which go with each other.
std::vector<PoseReading> PoseReadings(const Robot& robot,
                                      const PoseMeasurements& measured);

}  // namespace armcal
