#include "model/robot_files/mjcf_drive.h"

#include <cmath>

#include "model/robot_files/multiplied_gains.h"
#include "model/text/exact_text.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using tinyxml2::XMLElement;

// So large that a winding's current follows the torque asked for, whatever the
// velocity; with a motor constant of 1 N m/A.
constexpr double kResistance = 1e6;  // Ohm

PidGains TimesGain(const DriveLaw& law, double gain) {
  const PidGains gains = MultipliedOut(law);
  return {gain * gains.kp, gain * gains.ki, gain * gains.kd};
}

std::string Pair(double low, double high) {
  return ExactText(low) + " " + ExactText(high);
}

std::string Inputs(const ControllerOptions& controller, const DriveLaw& law) {
  std::string inputs = "pos";
  if (law.velocity_feedforward != 0) inputs += " vel";
  if (controller.feedforward != Feedforward::kNone) inputs += " ff";
  return inputs;
}

void SetServo(const PidGains& gains, XMLElement* element) {
  element->SetAttribute("biastype", "affine");
  element->SetAttribute("gainprm", ExactText(gains.kp).c_str());
  element->SetAttribute("biasprm", ("0 " + Pair(-gains.kp, -gains.kd)).c_str());
}

void SetPid(const PidGains& gains, const std::string& inputs,
            XMLElement* element) {
  element->SetAttribute("input", inputs.c_str());
  element->SetAttribute("kp", ExactText(gains.kp).c_str());
  element->SetAttribute("kv", ExactText(gains.kd).c_str());
  if (gains.ki != 0) element->SetAttribute("ki", ExactText(gains.ki).c_str());
}

void SetMotor(const PidGains& gains, const std::string& inputs, double limit,
              double lag, XMLElement* element) {
  element->SetAttribute("input", inputs.c_str());
  element->SetAttribute("motorconst", "1 1");
  element->SetAttribute("resistance", ExactText(kResistance).c_str());
  element->SetAttribute("inductance", Pair(0, lag).c_str());
  const double volts = std::isfinite(limit) ? limit * kResistance : 0;
  element->SetAttribute("controller",
                        (Pair(gains.kp, gains.ki) + " " + ExactText(gains.kd) +
                         " 0 0 " + ExactText(volts))
                            .c_str());
}

// Without a control.
void AddOffset(const Joint& joint, XMLElement* actuators) {
  XMLElement* element = actuators->InsertNewChildElement("general");
  element->SetAttribute("name", (joint.name + "_offset").c_str());
  element->SetAttribute("joint", joint.name.c_str());
  element->SetAttribute("gainprm", "0");
  element->SetAttribute("biastype", "affine");
  element->SetAttribute("biasprm", (ExactText(-joint.offset) + " 0 0").c_str());
}

// Names of the joints whose law has it, with its values.
template <typename Value>
std::string JointsWith(const RobotDescription& description,
                       const Value& value) {
  std::string text;
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    const double x = value(description.controller->drives[j]);
    if (x == 0) continue;
    text += (text.empty() ? "" : ", ") + description.robot.links[j].joint.name +
            Format(" %.4g", x);
  }
  return text;
}

void AddDrive(const Joint& joint, const JointDrive& drive,
              const ControllerOptions& controller, const DriveLaw& law,
              XMLElement* actuators) {
  const PidGains gains = TimesGain(law, drive.gain);
  const double limit =
      drive.gain * std::min(law.torque_limit, drive.torque_limit);
  const std::string inputs = Inputs(controller, law);
  const bool plain = inputs == "pos" && gains.ki == 0;
  XMLElement* element = actuators->InsertNewChildElement(law.lag > 0 ? "dcmotor"
                                                         : plain     ? "general"
                                                                     : "pid");
  element->SetAttribute("name", joint.name.c_str());
  element->SetAttribute("joint", joint.name.c_str());
  if (law.lag > 0) {
    SetMotor(gains, inputs, limit, law.lag, element);
  } else if (plain) {
    SetServo(gains, element);
  } else {
    SetPid(gains, inputs, element);
  }
  // A dcmotor takes one range for all its controls.
  const bool of_position = law.lag <= 0 || inputs == "pos";
  if (of_position && std::isfinite(joint.lower) && std::isfinite(joint.upper)) {
    element->SetAttribute("ctrllimited", "true");
    element->SetAttribute("ctrlrange", Pair(joint.lower, joint.upper).c_str());
  }
  if (law.lag <= 0 && std::isfinite(limit)) {
    element->SetAttribute("forcelimited", "true");
    element->SetAttribute("forcerange", Pair(-limit, limit).c_str());
  }
  SetMjcfDelay(controller.delay, 1 / controller.rate_hz, element);
}

}  // namespace

void AddMjcfDrives(const RobotDescription& description, XMLElement* actuators) {
  const ControllerOptions& controller = *description.controller;
  const std::vector<Link>& links = description.robot.links;
  for (int j = 0; j < description.robot.num_joints(); ++j) {
    AddDrive(links[j].joint, description.DriveOf(j), controller,
             controller.drives[j], actuators);
  }
  for (const Link& link : links) {
    if (link.joint.offset != 0) AddOffset(link.joint, actuators);
  }
}

void SetMjcfDelay(double delay, double timestep, XMLElement* actuator) {
  if (delay <= 0) return;
  const double steps = std::ceil(delay / timestep - 1e-9);
  actuator->SetAttribute("delay", ExactText(delay).c_str());
  actuator->SetAttribute("nsample", static_cast<int>(steps) + 1);
  actuator->SetAttribute("interp", "linear");
}

std::vector<std::string> MjcfDriveLosses(const RobotDescription& description) {
  if (!description.controller) return {};
  std::vector<std::string> losses;
  const auto add = [&](const std::string& what, const std::string& values) {
    if (!values.empty()) losses.push_back(what + " (" + values + ")");
  };
  add("MuJoCo's actuators do not limit the velocity that a cascade asks for",
      JointsWith(description, [](const DriveLaw& law) {
        return std::isfinite(law.velocity_limit) ? law.velocity_limit : 0;
      }));
  add("the vel controls are to be given this share of the reference's velocity",
      JointsWith(description, [](const DriveLaw& law) {
        return law.velocity_feedforward == 1 ? 0 : law.velocity_feedforward;
      }));
  add("in MuJoCo the integral of the velocity loop takes all of the "
      "reference's velocity, not this share less",
      JointsWith(description, [](const DriveLaw& law) {
        return law.velocity_ki == 0 ? 0 : 1 - law.velocity_feedforward;
      }));
  add("MuJoCo's integrals do not stop at the torque limit",
      JointsWith(description, [](const DriveLaw& law) {
        const bool winds = law.ki > 0 || law.velocity_ki > 0;
        return winds && std::isfinite(law.torque_limit) ? law.torque_limit : 0;
      }));
  if (description.controller->feedforward != Feedforward::kNone) {
    losses.push_back(
        "the ff controls are to be given the feedforward torque, which MuJoCo "
        "does not compute");
  }
  return losses;
}

}  // namespace armcal
