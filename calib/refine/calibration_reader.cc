#include "calib/refine/calibration_reader.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <vector>

#include "calib/linear/transition_choice.h"
#include "calib/numerics/json_value.h"
#include "calib/refine/robot_parameters.h"
#include "model/dynamics/drive_law.h"
#include "model/dynamics/proximal_chain.h"
#include "model/dynamics/robot_lengths.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

bool SameNumber(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)) + 1e-12;
}

void ExpectRefined(const JsonValue& root) {
  const JsonValue estimate = root.At("estimate");
  if (estimate.Text() != "refined") {
    estimate.Refuse(
        "expected 'refined': a simulation needs links that can exist; run "
        "armcal calibrate " +
        OptionName("estimate") +
        "=refined with a robot file that gives every link a mass");
  }
}

// Reads how each joint's Coulomb friction changes sign. Joints without friction
// have no entry; CheckFriction asks for one where the robot has friction.
std::vector<CoulombTransition> ReadTransitions(const JsonValue& root,
                                               const Robot& robot) {
  using Law = CoulombTransition::Law;
  std::vector<CoulombTransition> transitions(robot.num_joints());
  const std::vector<JsonValue> joints = root.At("joints").Entries();
  for (int j = 0; j < robot.num_joints(); ++j) {
    if (!joints[j].Has("coulomb_transition")) continue;  // without friction
    const JsonValue entry = joints[j].At("coulomb_transition");
    const std::string law = entry.At("law").Text();
    if (law != "velocity" && law != "displacement") {
      entry.At("law").Refuse("expected 'velocity' or 'displacement'");
    }
    const bool velocity = law == "velocity";
    entry.At("unit").Expect(PositionUnit(robot.links[j].joint.type) +
                                std::string(velocity ? "/s" : ""),
                            "");
    const double width = entry.At("width").Number();
    if (!(width >= kLeastTransition)) {
      entry.At("width").Refuse("expected a width of at least " +
                               NumberText(kLeastTransition));
    }
    transitions[j] = {velocity ? Law::kVelocity : Law::kDisplacement, width};
  }
  return transitions;
}

// The robot with the lengths that the linear calibration recovered. Each must
// be one of the robot file, with the value that it has there.
Robot WithLengthsOf(const JsonValue& root, const Robot& nominal) {
  const std::vector<Length> known = MakeProximalChain(nominal).lengths;
  std::vector<Length> lengths;
  for (const JsonValue& entry : root.At("geometry").Entries()) {
    if (!entry.Has("symbol")) continue;
    const std::string symbol = entry.At("symbol").Text();
    const auto length =
        std::find_if(known.begin(), known.end(),
                     [&symbol](const Length& l) { return l.name == symbol; });
    if (length == known.end() ||
        !SameNumber(length->value, entry.At("nominal").Number())) {
      entry.Refuse("expected a length of the robot file, as it has it");
    }
    lengths.push_back(*length);
    lengths.back().value = entry.At("used").Number();
  }
  return lengths.empty() ? nominal : WithLengths(nominal, lengths);
}

// Parameters that are no robot's: of where the instrument and its targets are,
// and of the controller. (Coulomb's width stands in coulomb_transition.)
bool IsNotTheRobots(const std::string& name) {
  // "target3.x", "instrument2": owners are numbered where there are several.
  const std::string owner = name.substr(0, name.find_first_of(".0123456789"));
  for (const char* other :
       {"instrument", "target", "point", "plane", "wire", "drive"}) {
    if (owner == other) return true;
  }
  const std::string term = name.substr(name.rfind('.') + 1);
  const std::vector<DriveParameter>& drive = DriveParameters();
  return term == "coulomb_width" ||
         std::any_of(drive.begin(), drive.end(),
                     [&](const DriveParameter& p) { return term == p.name; });
}

// Sets one parameter. The prior must be the value of the robot file at hand: a
// file that was changed since has other meanings for what stands beside it.
void SetFrom(const JsonValue& entry, RobotParameters* parameters,
             std::set<std::string>* were_set) {
  const JsonValue name = entry.At("name");
  const auto known = parameters->all().find(name.Text());
  if (known == parameters->all().end()) {
    if (IsNotTheRobots(name.Text())) return;
    name.Refuse("expected a parameter of the robot of " + OptionName("robot"));
  }
  if (!were_set->insert(name.Text()).second) {
    name.Refuse("expected every parameter only once");
  }
  const auto& [unit, nominal, now, geometric] = known->second;
  entry.At("unit").Expect(unit, ", the unit of " + name.Text());
  const JsonValue prior = entry.At("prior");
  if (!SameNumber(prior.Number(), nominal)) {
    prior.Refuse("expected " + NumberText(nominal) +
                 ", what the robot file has for " + name.Text() +
                 ": give the file that was calibrated, or calibrate again");
  }
  const JsonValue value = entry.At("value");
  if (IsNeverNegative(name.Text()) && value.Number() < 0) {
    value.Refuse("expected a number of at least 0, as " + name.Text() + " is");
  }
  parameters->Set(name.Text(), value.Number());
}

// The robot of `parameters`, each of which must be there once. Geometry may be
// missing: what was not refined is the file's.
Robot ReadRobotOf(const JsonValue& root, const Robot& nominal) {
  RobotParameters values(WithLengthsOf(root, nominal));
  std::set<std::string> were_set;
  for (const JsonValue& entry : root.At("parameters").Entries()) {
    SetFrom(entry, &values, &were_set);
  }
  for (const auto& [name, parameter] : values.all()) {
    if (parameter.geometric || were_set.count(name) > 0) continue;
    throw InputError(root.file(), "key parameters", "",
                     "expected an entry for " + name);
  }
  return values.Apply();
}

void CheckFriction(const JsonValue& root, const Robot& robot) {
  const std::vector<JsonValue> joints = root.At("joints").Entries();
  for (int j = 0; j < robot.num_joints(); ++j) {
    if (robot.links[j].joint.coulomb != 0) joints[j].At("coulomb_transition");
  }
}

// `path` as it is where nothing of it can be looked up.
std::string Canonical(const std::string& path) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(path, error);
  if (error) return path;
  const auto canonical = std::filesystem::weakly_canonical(absolute, error);
  return error ? path : canonical.string();
}

}  // namespace

// Asks for the format, the robot's name and its joints in their order: matrices
// and lists of a calibration go by these places.
void ExpectCalibrationOf(const Robot& robot, const JsonValue& root) {
  root.At("format").Expect("armcal calibration 1",
                           ", the format this version reads");
  const std::string other = ", the robot of " + OptionName("robot") +
                            ": this is a calibration of another robot";
  root.At("robot").Expect(robot.name, other);
  const JsonValue joints = root.At("joints");
  const std::vector<JsonValue> entries = joints.Entries();
  if (static_cast<int>(entries.size()) != robot.num_joints()) {
    joints.Refuse("expected " + std::to_string(robot.num_joints()) +
                  " joints, as the robot of " + OptionName("robot") + " has");
  }
  for (int j = 0; j < robot.num_joints(); ++j) {
    entries[j].At("name").Expect(robot.links[j].joint.name, other);
  }
}

// Paths are compared as what they lead to, since ./a.csv and a.csv are one
// file. A held-out figure on a log that the fit has seen would be no evidence.
bool CalibratedRobot::Saw(const std::string& log,
                          const TimeRange& range) const {
  for (size_t k = 0; k < logs.size(); ++k) {
    if (Canonical(logs[k]) == Canonical(log) &&
        range.begin < log_ranges[k].end && range.end > log_ranges[k].begin) {
      return true;
    }
  }
  return false;
}

// Checks come in the order in which a user can mend what they find: another
// robot, a linear estimate, single entries.
CalibratedRobot ReadCalibration(const std::string& path, const Robot& nominal) {
  const nlohmann::json parsed = ReadJson(path);
  const JsonValue root(path, "", parsed);
  ExpectCalibrationOf(nominal, root);
  ExpectRefined(root);
  CalibratedRobot result;
  result.transitions = ReadTransitions(root, nominal);
  result.robot = ReadRobotOf(root, nominal);
  CheckFriction(root, result.robot);
  result.bandwidth_hz = root.At("bandwidth_hz").Number();
  if (result.bandwidth_hz < 0) {
    root.At("bandwidth_hz").Refuse("expected a frequency in Hz, or 0");
  }
  result.converged = root.At("refined").At("converged").Bool();
  for (const JsonValue& log : root.At("logs").Entries()) {
    result.logs.push_back(log.At("file").Text());
    result.log_ranges.push_back(
        {log.At("begin_s").Number(), log.At("end_s").Number()});
  }
  return result;
}

}  // namespace armcal
