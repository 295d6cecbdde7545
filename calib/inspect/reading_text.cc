#include "calib/inspect/reading_text.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "model/robot/axis_rotation.h"
#include "model/text/enumeration.h"
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

const char* SignalOf(Kind kind) {
  return kind == Kind::kPositionSign || kind == Kind::kPositionsExchanged ||
                 kind == Kind::kAllPositionSigns
             ? "position"
             : "torque";
}

// Of positions or torques alone.
std::string FindingWord(Kind kind) {
  return std::string(SignalOf(kind)) +
         (IsOneSign(kind) || IsAllSigns(kind) ? "_sign" : "_order");
}

std::string JointList(const std::vector<int>& joints, const Robot& robot) {
  std::vector<std::string> names;
  for (const int j : joints) names.push_back(robot.links[j].joint.name);
  return Enumeration(names);
}

std::string JointNames(const ReadingChange& change, const Robot& robot) {
  return JointList(JointsOf(change), robot);
}

std::string Phrase(const ReadingChange& change, const Robot& robot) {
  if (IsAllSigns(change.kind)) {
    std::string all = std::string("all ") + SignalOf(change.kind) + "s";
    if (!change.but.empty()) {
      all += (change.but.size() > 1 ? " but those of " : " but that of ") +
             JointList(change.but, robot);
    }
    return all + " have the wrong sign";
  }
  const std::string signal = std::string("the ") + SignalOf(change.kind);
  const std::string joints = JointNames(change, robot);
  return IsOneSign(change.kind)
             ? signal + " of " + joints + " has the wrong sign"
             : signal + "s of " + joints + " are exchanged";
}

// The same change of the other signal in few words.
std::string Alternative(const ReadingChange& other, const ReadingChange& change,
                        const Robot& robot) {
  if (JointsOf(other) != JointsOf(change)) return Phrase(other, robot);
  const std::string signal = SignalOf(other.kind);
  if (IsAllSigns(other.kind)) return "all " + signal + "s";
  return IsOneSign(other.kind) ? "its " + signal : "their " + signal + "s";
}

void SayOneSignal(const ReadingChange& change, const Robot& robot,
                  InspectionFinding* finding) {
  finding->finding = FindingWord(change.kind);
  finding->sentence = Phrase(change, robot);
  for (const ReadingChange& other : change.alternatives) {
    finding->sentence += ", or " + Alternative(other, change, robot);
    finding->alternatives.push_back({FindingWord(other.kind), other.joint});
  }
}

}  // namespace

InspectionFinding FindingOf(const ReadingChange& change,
                            const LogReading& reading, const Robot& robot) {
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
  const std::string perhaps = change.is_doubt ? "perhaps " : "";
  switch (change.kind) {
    case Kind::kExchanged:
      finding.finding = "joint_order";
      finding.sentence =
          "the columns of " + JointNames(change, robot) + " are exchanged";
      break;
    case Kind::kPositionsExchanged:
    case Kind::kTorquesExchanged:
    case Kind::kPositionSign:
    case Kind::kTorqueSign:
    case Kind::kAllTorqueSigns:
    case Kind::kAllPositionSigns:
      SayOneSignal(change, robot, &finding);
      break;
    case Kind::kJointSign:
      finding.finding = "joint_sign";
      finding.sentence = JointNames(change, robot) +
                         " turns the other way than the robot file says";
      break;
    case Kind::kDegrees:
      finding.finding = "position_unit";
      finding.sentence =
          change.joint < 0
              ? "positions are " + perhaps + "in degrees, not in rad"
              : "the position of " + JointNames(change, robot) + " is " +
                    perhaps + "in degrees, not in rad as the others";
      finding.remedy = "name the columns q1[deg] ..., or " + OptionName("fix");
      break;
    case Kind::kMillimetres:
      finding.finding = "position_unit";
      finding.sentence = change.joint < 0
                             ? "positions of joints that slide are " + perhaps +
                                   "in mm, not in m"
                             : "the position of " + JointNames(change, robot) +
                                   " is " + perhaps + "in mm, not in m";
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
    case Kind::kTorqueUnit:
      finding.finding = "torque_unit";
      finding.sentence = "the torques are in another unit than N m";
      break;
  }
  return finding;
}

}  // namespace armcal
