#include "calib/log_readings.h"

#include <tbb/parallel_for.h>

#include <set>

#include "calib/inspect/inspection.h"
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

// Gravity so far from the file's is no tilt of the base, which is an effect
// that a diagnosis names by itself.
constexpr double kLeastCosine = .5;

bool IsTilt(const Robot& robot, const LogReading& reading) {
  const double sizes = reading.gravity.norm() * robot.gravity.norm();
  return sizes > 0 &&
         reading.gravity.dot(robot.gravity) >= kLeastCosine * sizes;
}

// What cannot be read at all is refused where the log is opened for what it is
// wanted for, which says more.
std::vector<InspectionFinding> FindingsOf(const Robot& robot,
                                          const LogSource& log,
                                          const LogReaderOptions& options,
                                          int most_rows) {
  try {
    LogInspection inspection = InspectLog(
        robot, log, options, 0, most_rows > 0 ? most_rows : kMostInspectedRows);
    if (IsTilt(robot, inspection.reading)) {
      DropFindings(
          [](const InspectionFinding& f) { return f.finding == "gravity"; },
          &inspection.findings);
    }
    return inspection.findings;
  } catch (const InputError&) {
    return {};
  }
}

bool Counts(const std::string& finding, const ReadingQuestions& questions) {
  return finding == "time_unit" ||
         (questions.arm && OfAnotherArm().count(finding) > 0) ||
         (questions.scales && OfAnotherScale().count(finding) > 0);
}

}  // namespace

std::vector<DataFinding> WrongReadings(const Robot& robot,
                                       const std::vector<LogSource>& logs,
                                       const LogReaderOptions& options,
                                       const ReadingQuestions& questions) {
  std::vector<std::vector<InspectionFinding>> findings(logs.size());
  tbb::parallel_for(size_t{0}, logs.size(), [&](size_t k) {
    findings[k] = FindingsOf(robot, logs[k], options, questions.most_rows);
  });
  std::vector<DataFinding> wrong;
  for (size_t k = 0; k < logs.size(); ++k) {
    for (const InspectionFinding& found : findings[k]) {
      if (!Counts(found.finding, questions)) continue;
      wrong.push_back({"of " + logs[k].name + " " + found.sentence,
                       found.evidence, "armcal inspect: " + found.remedy,
                       true});
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
