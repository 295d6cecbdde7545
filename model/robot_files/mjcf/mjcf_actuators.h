#pragma once

#include "model/robot_files/mjcf/mjcf_defaults.h"
#include "model/robot_files/mjcf/mjcf_settings.h"
#include "model/robot_tree/robot_tree.h"

namespace armcal {

// What a file's actuators say of its joints: the largest effort, from
// forcerange or, of plain motors, ctrlrange, times gear; and a constant torque,
// from the bias of a motor. Servos' gains are not the robot's. Throws
// InputError.
void ReadMjcfActuators(const XmlElement& root, const MjcfDefaults& defaults,
                       const MjcfSettings& settings, RobotTree* tree);

}  // namespace armcal
