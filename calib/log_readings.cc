#include "calib/log_readings.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "calib/inspect/inspection.h"
#include "calib/inspect/torque_scale.h"
#include "model/text/format.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

const std::set<std::string>& OfAnotherArm() {
  static const std::set<std::string> kFindings = {
      "position_unit", "joint_order",     "position_order",
      "torque_order",  "joint_sign",      "torque_sign",
      "position_sign", "unsigned_torque", "gravity"};
  return kFindings;
}

const std::set<std::string>& OfAnotherScale() {
  static const std::set<std::string> kFindings = {"torque_unit",
                                                  "torque_is_current"};
  return kFindings;
}

// It may as well be the centres of mass that the file has wrong.
constexpr char kDoubtOfFile[] = "joint_zero";

// Gravity so far from the file's is no tilt of the base, which is an effect
// that a diagnosis names by itself.
constexpr double kLeastCosine = .5;

bool IsTilt(const Robot& robot, const LogReading& reading) {
  const double sizes = reading.gravity.norm() * robot.gravity.norm();
  return sizes > 0 &&
         reading.gravity.dot(robot.gravity) >= kLeastCosine * sizes;
}

// Takes out what was said of rows when these were left out.
void DropTold(const std::vector<RowRange>& left_out,
              LogInspection* inspection) {
  const auto are_left_out = [&](const FrozenChannel& run) {
    return std::any_of(left_out.begin(), left_out.end(),
                       [&](const RowRange& rows) {
                         return rows.begin < run.end && run.begin < rows.end;
                       });
  };
  const auto is_told = [&](const InspectionFinding& f) {
    if (!f.leads) return false;
    if (f.finding == "position_jump") return true;
    const bool is_position = f.sentence.rfind("the position", 0) == 0;
    return f.finding == "stuck" &&
           std::any_of(inspection->frozen.begin(), inspection->frozen.end(),
                       [&](const FrozenChannel& run) {
                         return run.joint == f.joint &&
                                run.is_position == is_position &&
                                are_left_out(run);
                       });
  };
  DropFindings(is_told, &inspection->findings);
}

// What cannot be read at all is refused where the log is opened for what it is
// wanted for, which says more.
std::optional<LogInspection> Inspected(const Robot& robot, const LogSource& log,
                                       const LogReaderOptions& options,
                                       int most_rows) {
  try {
    // It leaves the same rows out by itself.
    LogReaderOptions whole = options;
    whole.left_out.clear();
    LogInspection inspection = InspectLog(
        robot, log, whole, 0, most_rows > 0 ? most_rows : kMostInspectedRows);
    if (IsTilt(robot, inspection.reading)) {
      DropFindings(
          [](const InspectionFinding& f) { return f.finding == "gravity"; },
          &inspection.findings);
    }
    const auto left_out = options.left_out.find(log.name);
    if (left_out != options.left_out.end()) {
      DropTold(left_out->second, &inspection);
    }
    return inspection;
  } catch (const InputError&) {
    return {};
  }
}

// How many times what the robot's links need a log's torques are: from the
// lowest to the highest that the 95 % intervals of its joints hold.
struct ScaleRange {
  int joints = 0;
  double low = INFINITY, high = 0;
};

ScaleRange RangeOf(const TorqueScales& scales) {
  ScaleRange range;
  for (int j = 0; j < scales.scale.size(); ++j) {
    if (!scales.told(j) || !(scales.low[j] > 0)) continue;
    ++range.joints;
    range.low = std::min(range.low, scales.low[j]);
    range.high = std::max(range.high, scales.high[j]);
  }
  return range;
}

// All joints of one log have to be beyond all of the other's, two at least,
// since a load may be several times a single joint's link. Of an arm that has
// no other joint it is no hundred times that: a body of fifty times the link's
// mass at its end, where the link's own centre is half way.
std::vector<DataFinding> OtherUnits(const LogSource& log,
                                    const TorqueScales& scales,
                                    const LogSource& other,
                                    const TorqueScales& others) {
  constexpr double kNoLoad = 100;
  const ScaleRange own = RangeOf(scales), its = RangeOf(others);
  if (own.joints == 0 || its.joints == 0) return {};
  const bool is_all_of_it = scales.scale.size() == 1;
  if (std::max(own.joints, its.joints) == 1 && !is_all_of_it) return {};
  const double factor = is_all_of_it ? kNoLoad : kNotInertia;
  if (own.low <= factor * its.high && own.high >= its.low / factor) return {};
  return {{"the torques of " + log.name + " and of " + other.name +
               " are not in one unit",
           Format("%.3g to %.3g times what the robot's links need, and %.3g to "
                  "%.3g times (95 %%)",
                  own.low, own.high, its.low, its.high),
           "log both alike, or name the unit behind a column's name, as tau1 "
           "[mNm]",
           true}};
}

bool Counts(const std::string& finding, const ReadingQuestions& questions) {
  return finding == "time_unit" || finding == "row_counter" ||
         (questions.arm && OfAnotherArm().count(finding) > 0) ||
         (questions.scales && OfAnotherScale().count(finding) > 0) ||
         (questions.arm && questions.scales && finding == kDoubtOfFile);
}

DataFinding Told(const LogSource& log, const InspectionFinding& found) {
  const bool is_doubt = found.finding == kDoubtOfFile;
  return {(is_doubt ? "as " + log.name + " has it, " : "of " + log.name + " ") +
              found.sentence,
          found.evidence, "armcal inspect: " + found.remedy, true, is_doubt};
}

}  // namespace

std::vector<UsedLog> UsedParts(const std::vector<const LogInput*>& inputs) {
  std::vector<UsedLog> used;
  for (const LogInput* input : inputs) {
    for (const LogSource& log : input->logs) {
      used.push_back({log, input->crop});
    }
  }
  return used;
}

std::vector<DataFinding> WrongReadings(const Robot& robot,
                                       const std::vector<LogSource>& logs,
                                       const LogReaderOptions& options,
                                       const ReadingQuestions& questions) {
  std::vector<std::optional<LogInspection>> inspected(logs.size());
  tbb::parallel_for(size_t{0}, logs.size(), [&](size_t k) {
    inspected[k] = Inspected(robot, logs[k], options, questions.most_rows);
  });
  std::vector<DataFinding> wrong;
  for (size_t k = 0; k < logs.size(); ++k) {
    if (!inspected[k]) continue;
    if (!questions.scales && inspected[0]) {
      for (DataFinding& found :
           OtherUnits(logs[k], inspected[k]->torque_scales, logs[0],
                      inspected[0]->torque_scales)) {
        wrong.push_back(std::move(found));
      }
    }
    for (const InspectionFinding& found : inspected[k]->findings) {
      if (!found.leads && !Counts(found.finding, questions)) continue;
      wrong.push_back(Told(logs[k], found));
    }
  }
  return wrong;
}

std::vector<DataFinding> WrongReadings(const Robot& robot,
                                       const std::vector<LogSource>& logs,
                                       const LogReaderOptions& options,
                                       bool scales) {
  ReadingQuestions questions;
  questions.scales = scales;
  return WrongReadings(robot, logs, options, questions);
}

}  // namespace armcal
