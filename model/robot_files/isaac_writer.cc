#include "model/robot_files/isaac_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "model/robot_files/multiplied_gains.h"
#include "model/text/exact_text.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

// A text that Python reads as itself: JSON's strings, ASCII alone, are.
std::string PythonText(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true,
                                   nlohmann::json::error_handler_t::replace);
}

// Isaac Lab matches joints' names as regular expressions.
std::string NamePattern(const std::string& name) {
  std::string pattern;
  for (const char c : name) {
    if (std::string(".^$*+?{}[]\\|()").find(c) != std::string::npos) {
      pattern += '\\';
    }
    pattern += c;
  }
  return PythonText(pattern);
}

void AddField(const char* key, double value, std::string* text) {
  if (!std::isfinite(value)) return;
  *text += "            " + std::string(key) + "=" + ExactText(value) + ",\n";
}

PidGains GainsOf(const RobotDescription& description, int joint) {
  if (!description.controller) return {0, 0, 0};
  return MultipliedOut(description.controller->drives.at(joint));
}

bool IsDelayed(const RobotDescription& description) {
  return description.controller && description.controller->delay > 0;
}

// Isaac Lab's motor whose torque falls with speed has no delay.
bool FallsWithSpeed(const RobotDescription& description, int joint) {
  return !IsDelayed(description) &&
         description.DriveOf(joint).torque_limit_slope > 0;
}

// Of Isaac Lab's actuators the one that this joint has.
std::string ConfigurationOf(const RobotDescription& description, int joint) {
  return IsDelayed(description)               ? "DelayedPDActuatorCfg"
         : FallsWithSpeed(description, joint) ? "DCMotorCfg"
                                              : "IdealPDActuatorCfg";
}

// What torque and speed are held within. A DC motor's torque is limited by
//   saturation_effort (1 - v / velocity_limit),
// below 0 beyond that speed, and both ways by effort_limit, which it has to
// have: a motor that brakes has twice its torque at rest at most.
void AddLimits(const RobotDescription& description, int j, std::string* text) {
  const Joint& joint = description.robot.links[j].joint;
  const JointDrive drive = description.DriveOf(j);
  const double limit = drive.torque_limit;
  if (FallsWithSpeed(description, j)) {
    AddField("effort_limit",
             std::isfinite(joint.effort) ? joint.effort : 2 * limit, text);
    AddField("saturation_effort", limit, text);
    AddField("velocity_limit", limit / drive.torque_limit_slope, text);
  } else {
    AddField("effort_limit", std::min(joint.effort, limit), text);
  }
  AddField("velocity_limit_sim", joint.velocity, text);
}

void AddActuator(const RobotDescription& description, int j,
                 std::string* text) {
  const Joint& joint = description.robot.links[j].joint;
  const PidGains gains = GainsOf(description, j);
  *text += "        " + PythonText(joint.name) + ": " +
           ConfigurationOf(description, j) +
           "(\n            joint_names_expr=[" + NamePattern(joint.name) +
           "],\n";
  AddField("stiffness", gains.kp, text);
  AddField("damping", gains.kd, text);
  AddLimits(description, j, text);
  AddField("armature", joint.armature, text);
  AddField("friction", joint.coulomb, text);
  AddField("dynamic_friction", joint.coulomb, text);
  AddField("viscous_friction", joint.viscous, text);
  if (IsDelayed(description)) {
    *text += "            min_delay=delay, max_delay=delay,\n";
  }
  *text += "        ),\n";
}

std::vector<std::string> IsaacLosses(const RobotDescription& description) {
  std::vector<std::string> losses;
  if (!description.controller) return losses;
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    if (IsDelayed(description) &&
        description.DriveOf(j).torque_limit_slope > 0) {
      losses.push_back(
          "Isaac Lab's delayed actuators have no limit of torque "
          "that falls with speed (" +
          description.robot.links[j].joint.name + ")");
    }
  }
  const ControllerOptions& controller = *description.controller;
  const auto any = [&](auto has) {
    for (const DriveLaw& law : controller.drives) {
      if (has(law)) return true;
    }
    return false;
  };
  const auto add = [&](const std::string& what) {
    losses.push_back("Isaac Lab's PD actuators have no " + what);
  };
  if (any([](const DriveLaw& law) { return MultipliedOut(law).ki != 0; })) {
    add("integral gain");
  }
  if (any([](const DriveLaw& law) { return law.lag != 0; })) {
    add("lag of the torque");
  }
  if (any([](const DriveLaw& law) {
        return std::isfinite(law.velocity_limit);
      })) {
    add("limit of the velocity asked for");
  }
  if (any([](const DriveLaw& law) { return law.velocity_feedforward != 1; })) {
    add("share of the reference's velocity: give velocity targets times it");
  }
  if (controller.feedforward != Feedforward::kNone) {
    add("feedforward of their own: give it as effort targets");
  }
  return losses;
}

}  // namespace

std::string MakeIsaac(const RobotDescription& description) {
  const bool delayed = IsDelayed(description);
  std::string text =
      "\"\"\"Actuators of a robot for Isaac Lab 2.1 and later, whose bodies "
      "are in robot.urdf:\n\n"
      "    ArticulationCfg(spawn=UrdfFileCfg(asset_path=\"robot.urdf\", "
      "fix_base=True, ...),\n"
      "                    actuators=actuators(physics_dt=0.005))\n\n"
      "Friction is in N m (N), as Isaac Sim 5.0 and later take it.";
  text += description.controller
              ? " Commands are joint positions and velocities."
              : " Commands are joint efforts: stiffness and damping are 0.";
  std::set<std::string> used;
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    used.insert(ConfigurationOf(description, j));
  }
  text += "\n\"\"\"\n\nfrom isaaclab.actuators import " +
          JoinNames({used.begin(), used.end()}) + "\n\n\n";
  if (delayed) {
    text += "DELAY = " + ExactText(description.controller->delay) +
            "  # s, of commands\n\n\n";
  }
  text += "def actuators(physics_dt=0.005):\n";
  if (delayed) text += "    delay = round(DELAY / physics_dt)\n";
  text += "    return {\n";
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    AddActuator(description, j, &text);
  }
  return text + "    }\n";
}

RobotFormat IsaacFormat() {
  return {"isaac",
          "Isaac Lab",
          "isaac_actuators.py",
          {RobotField::kOffset, RobotField::kSpring, RobotField::kGain,
           RobotField::kLaws, RobotField::kGravity},
          &MakeIsaac,
          &IsaacLosses,
          false,
          true};
}

}  // namespace armcal
