#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/robot_files/robot_format.h"

namespace armcal {

// The laws of JointDrive in MuJoCo's own fields:
//
//   dry       frictionloss of the joint and of tendons on it alone, and
//             actuators that push where it falls with velocity
//             (mjcf_saturation.h)
//   bounded   tendons with dead bands on this joint alone, likewise; 2.3.1 and
//             later
//   bristles  lugre of a dcmotor that has no control; 3.12 and later
//   waves     cogging of such a dcmotor
//   gear      a second joint NAME_gear of the body, about the same axis: the
//             first one is the motor with its armature and friction, the second
//             what the link is behind it. A spring is its stiffness, a gap its
//             range, whose soft limit has the flanks' spring and damper
//   quadratic the second number of damping; 3.7 and later
//
// MuJoCo makes soft constraints of accelerations: forces of the size that is
// meant come out where the constraint is far softer than the inertia that
// MuJoCo works out for it at the position 0, which is why this is needed here.
class MjcfLaws {
 public:
  explicit MjcfLaws(const RobotDescription& description);

  bool any() const;
  // s, in which the laws are stable: 1 ms by a whole number, at most by 10.
  double timestep() const;
  // Friction of joint j, and, behind it in the body, its gear.
  void AddToJoint(int j, tinyxml2::XMLElement* joint) const;
  // After all that have controls, so that these keep their numbers.
  void AddActuators(tinyxml2::XMLElement* actuators) const;
  void AddTendons(tinyxml2::XMLElement* root) const;
  // Sentences.
  std::vector<std::string> Losses() const;

 private:
  void AddGear(int j, tinyxml2::XMLElement* motor) const;
  double StepOf(int j) const;
  std::string Version() const;

  const RobotDescription& description_;
  // Per joint, 1/(kg m^2) or 1/kg: of the motor, and of the link against it.
  Eigen::VectorXd motor_, gear_;
};

}  // namespace armcal
