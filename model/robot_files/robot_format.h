#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model/dynamics/joint_controller.h"
#include "model/robot/joint_drive.h"
#include "model/robot/robot.h"

namespace armcal {

// A robot as files describe it to simulators.
struct RobotDescription {
  Robot robot;
  std::vector<JointDrive> drives;  // per joint; empty: nothing beside
  // What moves it where commands are positions; none: torques are given.
  std::optional<ControllerOptions> controller = std::nullopt;
  double torque_delay = 0;  // s; torque acts this much after it is asked for

  JointDrive DriveOf(int joint) const {
    return drives.empty() ? JointDrive() : drives[joint];
  }
};

// What some formats have no field for.
enum class RobotField {
  kArmature,
  kOffset,
  kSpring,
  kGain,
  kTorqueLimit,       // JointDrive's, not the joint's own effort
  kTorqueLimitSlope,  // that it falls with speed
  kLaws,  // JointDrive's beyond a spring and a gain, and a delay of torque
  kVelocityLimit,
  kGravity,
  kController
};

struct RobotFormat {
  const char* name;   // as --export takes it: "mjcf"
  const char* title;  // for people: "MJCF"
  const char* file;   // "robot.xml"
  std::vector<RobotField> lacks;
  std::string (*write)(const RobotDescription&);
  // Further losses, a sentence each; may be null.
  std::vector<std::string> (*more_losses)(const RobotDescription&);
  // A robot by itself; else what stands beside the bodies of robot.urdf.
  bool is_whole = true;
  // Whether comments are lines behind a #; else those of XML.
  bool hash_comments = false;

  bool Holds(RobotField field) const;
  // All that the joint and its drive have.
  bool Holds(const Joint& joint, const JointDrive& drive) const;
};

// The file's text with these sentences before all else, in a comment of
// armcal's own in the place of one that it has.
std::string WithComment(const RobotFormat& format, std::string text,
                        const std::vector<std::string>& sentences);

// What a file of this format cannot say of the robot, a sentence for each kind
// with the joints' values.
std::vector<std::string> Losses(const RobotFormat& format,
                                const RobotDescription& description);

}  // namespace armcal
