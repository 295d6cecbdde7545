#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "model/dynamics/joint_controller.h"
#include "model/robot_files/robot_format.h"

namespace armcal {

// How a joint's drive is written for MuJoCo, by what it needs:
//
//   general   a position gain and damping; one control, the position. MuJoCo
//             2.2.2 and later
//   pid       further integrals, velocity of the reference, feedforward:
//             controls pos, vel, ff as far as needed. 3.12 and later
//   dcmotor   a lag, as the electrical one of a winding whose own constants
//             cancel; controls as of pid. 3.12 and later
//
// Gains are those of the law; those of a cascade are multiplied out, which is
// exact where velocity_feedforward is 1 or there is no velocity_ki. Constant
// torques of joints are actuators of their own after all drives.
void AddMjcfDrives(const RobotDescription& description,
                   tinyxml2::XMLElement* actuators);

// Controls act `delay` (s) after they are given, out of a buffer of time steps.
void SetMjcfDelay(double delay, double timestep,
                  tinyxml2::XMLElement* actuator);

// What MuJoCo's actuators lack of the drives, sentences.
std::vector<std::string> MjcfDriveLosses(const RobotDescription& description);

}  // namespace armcal
