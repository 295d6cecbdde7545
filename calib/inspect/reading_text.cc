#include "calib/inspect/reading_text.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/robot/axis_rotation.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Kind = ReadingChange::Kind;

void SayGravity(const Eigen::Vector3d& gravity, const Robot& robot,
                InspectionFinding* finding) {
  if (gravity.norm() == 0) {
    finding->finding = "gravity_compensated";
    finding->sentence = "the torques hold no gravity";
    finding->remedy =
        OptionName("gravity") + "=0,0,0, or log torques that hold it";
    return;
  }
  const double angle =
      std::acos(std::clamp(gravity.normalized().dot(robot.gravity.normalized()),
                           -1., 1.)) /
      kDegree;
  finding->finding = "gravity";
  finding->sentence = Format(
      "gravity points %.0f degrees away from where the robot file has it",
      angle);
  finding->remedy =
      OptionName("gravity") +
      Format("=%.3g,%.3g,%.3g", gravity[0], gravity[1], gravity[2]);
}

void SaySign(const ReadingChange& change, const char* signal, const char* other,
             const std::string& joint, InspectionFinding* finding) {
  finding->finding = std::string(signal) + "_sign";
  finding->sentence =
      std::string("the ") + signal + " of " + joint + " has the wrong sign";
  if (change.or_other_signal)
    finding->sentence += std::string(", or its ") + other;
}

// Of positions or torques alone.
void SayOrder(const ReadingChange& change, const char* signal,
              const char* other, const std::string& joints,
              InspectionFinding* finding) {
  finding->finding = std::string(signal) + "_order";
  finding->sentence =
      std::string("the ") + signal + "s of " + joints + " are exchanged";
  finding->sentence += change.or_other_signal
                           ? std::string(", or their ") + other + "s"
                           : std::string(", their ") + other + "s are not";
}

}  // namespace

InspectionFinding FindingOf(const ReadingChange& change,
                            const LogReading& reading, const Robot& robot) {
  const auto name = [&](int j) { return robot.links[j].joint.name; };
  const auto names = [&] {
    return name(change.joint) + " and " + name(change.other);
  };
  InspectionFinding finding;
  finding.joint = change.joint;
  finding.probability = change.probability;
  finding.held_out_before = change.held_out_before;
  finding.held_out_after = change.held_out_after;
  finding.evidence = Format(
      "of torques held out a fit leaves %.3g %% as logged and %.3g %% so (%.0f "
      "nats)",
      change.held_out_before, change.held_out_after, change.gain);
  if (!change.hint.empty()) finding.evidence += "; " + change.hint;
  finding.remedy = OptionName("fix") + " writes the log so";
  switch (change.kind) {
    case Kind::kExchanged:
      finding.finding = "joint_order";
      finding.sentence = "the columns of " + names() + " are exchanged";
      break;
    case Kind::kPositionsExchanged:
      SayOrder(change, "position", "torque", names(), &finding);
      break;
    case Kind::kTorquesExchanged:
      SayOrder(change, "torque", "position", names(), &finding);
      break;
    case Kind::kPositionSign:
      SaySign(change, "position", "torque", name(change.joint), &finding);
      break;
    case Kind::kTorqueSign:
      SaySign(change, "torque", "position", name(change.joint), &finding);
      break;
    case Kind::kJointSign:
      finding.finding = "joint_sign";
      finding.sentence =
          name(change.joint) + " turns the other way than the robot file says";
      break;
    case Kind::kDegrees:
      finding.finding = "position_unit";
      finding.sentence = "positions are in degrees, not in rad";
      finding.remedy = "name the columns q1[deg] ..., or " + OptionName("fix");
      break;
    case Kind::kMillimetres:
      finding.finding = "position_unit";
      finding.sentence = "positions of joints that slide are in mm, not in m";
      finding.remedy = "name their columns q3[mm] ..., or " + OptionName("fix");
      break;
    case Kind::kGravity:
      SayGravity(reading.gravity, robot, &finding);
      break;
    case Kind::kDelay:
      finding.finding = "delay";
      finding.sentence = Format("torques are recorded %.1f ms %s the positions",
                                1e3 * std::abs(reading.delay),
                                reading.delay > 0 ? "after" : "before");
      finding.remedy = "shift the torques by that time";
      break;
  }
  return finding;
}

}  // namespace armcal
