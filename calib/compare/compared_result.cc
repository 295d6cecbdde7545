#include "calib/compare/compared_result.h"

#include <cmath>
#include <filesystem>

#include "calib/numerics/json_value.h"
#include "calib/refine/covariance_file.h"
#include "calib/refine/robot_parameters.h"
#include "model/text/format.h"
#include "model/text/input_error.h"
#include "model/text/input_text.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;
using Kind = ComparedResult::Kind;

constexpr const char* kResultFiles[] = {"calibration.json", "diagnosis.json",
                                        "verification.json"};

// The result in a folder; anything else as it is.
std::string FileOf(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  std::vector<std::string> found;
  for (const char* name : kResultFiles) {
    if (fs::exists(fs::path(path) / name, error)) found.push_back(name);
  }
  if (found.size() == 1) return fs::path(path) / found[0];
  throw InputError(path, "", "",
                   found.empty()
                       ? "expected one of calibration.json, diagnosis.json and "
                         "verification.json in this folder"
                       : "this folder has " + JoinNames(found) +
                             ": give the file that is meant");
}

ComparedValue ReadValue(const JsonValue& entry, const std::string& prefix) {
  return {prefix + entry.At("name").Text(), entry.At("unit").Text(),
          entry.At("value").NumberOrNull(), entry.At("stddev").NumberOrNull()};
}

void AddSet(const JsonValue& root, const std::string& list,
            const std::string& covariance, ComparedResult* result) {
  if (!root.Has(list) || !root.Has(covariance)) return;
  ComparedValues set;
  for (const JsonValue& entry : root.At(list).Entries()) {
    set.values.push_back(ReadValue(entry, ""));
  }
  if (set.values.empty()) return;
  const fs::path name = root.At(covariance).At("file").Text();
  set.covariance =
      ReadCovarianceCsv(fs::path(root.file()).replace_filename(name.filename()),
                        static_cast<int>(set.values.size()));
  for (size_t k = 0; k < set.values.size(); ++k) {
    const double stddev = set.values[k].stddev;
    const double variance = set.covariance(k, k);
    if (std::isnan(stddev) ||
        std::abs(variance - stddev * stddev) <= .01 * stddev * stddev) {
      continue;
    }
    root.At(covariance)
        .At("file")
        .Refuse("expected the covariance of " + list +
                " in it, whose standard "
                "deviations are others");
  }
  result->sets.push_back(set);
}

std::vector<ComparedLog> LogsOf(const JsonValue& root) {
  std::vector<ComparedLog> logs;
  if (!root.Has("logs")) return logs;
  for (const JsonValue& log : root.At("logs").Entries()) {
    logs.push_back({log.At("file").Text(), log.At("begin_s").Number(),
                    log.At("end_s").Number()});
  }
  return logs;
}

void ReadCalibrationInto(const JsonValue& root, ComparedResult* result) {
  AddSet(root, "model_parameters", "covariance", result);
  if (root.Has("refined")) {
    AddSet(root, "parameters", "parameters_covariance", result);
  }
  if (result->sets.empty()) {
    throw InputError(root.file(), "", "",
                     "expected parameters with a covariance in it: this "
                     "calibration was not solved");
  }
  result->logs = LogsOf(root);
  result->verdict = "calibrated";
  if (!root.Has("stacked_residual_percent")) return;
  const double left = root.At("stacked_residual_percent").NumberOrNull();
  if (!std::isnan(left)) result->verdict += Format(", residual %.3g %%", left);
}

using Names = std::vector<std::string>;

// "payload", "stribeck of elbow".
std::string OfJoint(const JsonValue& entry, const std::string& joint) {
  const std::string effect = entry.At("effect").Text();
  return joint.empty() ? effect : effect + " of " + joint;
}

// The same by a joint's number from 1.
std::string PlaceOf(const JsonValue& entry, const Names& joints) {
  const auto joint = static_cast<size_t>(entry.At("joint_index").Count());
  return OfJoint(entry,
                 joint < 1 || joint > joints.size() ? "" : joints[joint - 1]);
}

void AddClaims(const JsonValue& list, const Names& joints,
               ComparedResult* result, ComparedValues* values) {
  for (const JsonValue& entry : list.Entries()) {
    ComparedClaim claim;
    claim.name = PlaceOf(entry, joints);
    claim.probability = entry.At("probability").Number();
    claim.claimed = claim.probability >= .5;
    for (const JsonValue& rival : entry.At("equivalent").Entries()) {
      claim.rivals.push_back(PlaceOf(rival, joints));
    }
    for (const JsonValue& estimate : entry.At("estimates").Entries()) {
      values->values.push_back(ReadValue(estimate, claim.name + ": "));
    }
    result->claims.push_back(claim);
  }
}

void ReadDiagnosisInto(const JsonValue& root, ComparedResult* result) {
  ComparedValues values;
  Names joints;
  for (const JsonValue& joint : root.At("where").At("joints").Entries()) {
    joints.push_back(joint.At("name").Text());
  }
  AddClaims(root.At("effects"), joints, result, &values);
  result->sets.push_back(values);
  for (const JsonValue& entry : root.At("untestable").Entries()) {
    result->untestable.push_back(OfJoint(entry, entry.At("joint").Text()));
  }
  result->verdict = root.At("verdict").Text();
}

// Simulated positions with their intervals; checks that failed are in words.
void ReadVerificationInto(const JsonValue& root, ComparedResult* result) {
  constexpr double kDeviations = 1.96;  // half an interval of 95 %
  ComparedValues values;
  for (const JsonValue& rollout : root.At("rollout").Entries()) {
    const double seconds = rollout.At("window_s").Number();
    const std::vector<JsonValue> ci = rollout.At("ci95").Entries();
    if (ci.size() != 2) rollout.At("ci95").Refuse("expected two numbers");
    const double after = rollout.At("after_rms").NumberOrNull();
    values.values.push_back(
        {Format("error after %g s", seconds), rollout.At("unit").Text(),
         std::isnan(after) ? rollout.At("before_rms").NumberOrNull() : after,
         (ci[1].NumberOrNull() - ci[0].NumberOrNull()) / (2 * kDeviations)});
  }
  result->sets.push_back(values);
  result->verdict = root.At("passed").Bool() ? "verified" : "not verified";
}

// Of a robot: its parameters, exact.
ComparedResult ResultOf(const std::string& path, const Robot& robot) {
  ComparedResult result{path, Kind::kRobot, robot.name, "robot file",
                        {},   {},           {},         {}};
  ComparedValues set;
  const RobotParameters parameters(robot);
  for (const auto& [name, parameter] : parameters.all()) {
    set.values.push_back({name, parameter.unit, parameter.value, 0});
  }
  result.sets.push_back(set);
  result.robot_file = robot;
  return result;
}

}  // namespace

const char* KindName(Kind kind) {
  switch (kind) {
    case Kind::kCalibration:
      return "calibration";
    case Kind::kDiagnosis:
      return "diagnosis";
    case Kind::kVerification:
      return "verification";
    case Kind::kRobot:
      return "robot";
  }
  return "";
}

ComparedResult ReadResult(const std::string& path,
                          const RobotReader& read_robot) {
  const std::string file = FileOf(path);
  if (fs::path(file).extension() != ".json") {
    return ResultOf(path, read_robot(file));
  }
  const nlohmann::json text = ReadJson(file);
  const JsonValue root(file, "", text);
  const std::string format = root.At("format").Text();
  ComparedResult result{
      path, Kind::kCalibration, root.At("robot").Text(), "", {}, {}, {}, {}};
  result.file = file;
  if (format == "armcal calibration 1") {
    ReadCalibrationInto(root, &result);
  } else if (format == "armcal diagnosis 1") {
    result.kind = Kind::kDiagnosis;
    ReadDiagnosisInto(root, &result);
  } else if (format == "armcal verification 1") {
    result.kind = Kind::kVerification;
    ReadVerificationInto(root, &result);
  } else {
    root.At("format").Refuse(
        "expected a result of armcal calibrate, merge, diagnose or verify");
  }
  return result;
}

}  // namespace armcal
