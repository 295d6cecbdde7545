#include "calib/log_doubts.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "calib/log_readings.h"
#include "calib/numerics/median.h"
#include "calib/refine/far_masses.h"

namespace armcal {
namespace {

// s; no arm is logged at larger steps (AuditStamps).
constexpr double kSlowestStep = .25;
// Of one joint's torque: what an arm leaves of one that is read rightly
// (FindTorqueUnits). Of 61 faults planted in ten logs of ../shared/data (signs,
// order, degrees, mm, lost signs) that are told here, some joint leaves 16.7 %
// and more of each; the logs of panda and ur10e as they are leave 8.4 % and
// 7.9 % of the worst.
constexpr double kUsuallyLeft = 10;
// Of masses over the file's, the links' median: the root of the factor 4 beyond
// which torques are told to be in another unit (FindTorqueUnits). Links that
// the motion does not show stay at the file's masses. On panda and ur10e 1.1
// to 1.2, with torques five times as large 4.1 to 4.5, with a fifth .25 to .34.
constexpr double kSameSize = 2;
constexpr size_t kMostAskedLogs = 4;
// A minute at 1 kHz, which is 10 MB of a robot of seven joints.
constexpr int kMostAskedRows = 1 << 16;

bool IsTooSlow(const LogSet& logs) {
  const auto& bases = logs.time_bases();
  return std::any_of(bases.begin(), bases.end(), [](const TimeBase& base) {
    return base.dt > kSlowestStep;
  });
}

bool LeavesMuch(const TorqueResidual& residual) {
  const Eigen::VectorXd percent = residual.moving().percent;
  return (percent.array() > kUsuallyLeft).any();
}

bool HasMassesOfOtherSize(const NonlinearCalibration& refined) {
  std::vector<double> sizes;
  for (int i = 0; i < refined.robot.num_joints(); ++i) {
    const double file = refined.nominal.links[i].inertial.mass;
    if (!(file > 0)) continue;
    sizes.push_back(std::log(refined.robot.links[i].inertial.mass / file));
  }
  return !sizes.empty() && std::abs(Median(sizes)) > std::log(kSameSize);
}

std::vector<LogSource> Some(const std::vector<LogSource>& logs) {
  if (logs.size() <= kMostAskedLogs) return logs;
  std::vector<LogSource> some;
  for (size_t k = 0; k < kMostAskedLogs; ++k) {
    some.push_back(logs[k * (logs.size() - 1) / (kMostAskedLogs - 1)]);
  }
  return some;
}

// A file without masses tells nothing of torques, nor do lengths that are to be
// estimated; and where the scale of torques is estimated, it is not asked for.
ReadingQuestions QuestionsOf(const Robot& robot,
                             const CalibrateOptions& options) {
  ReadingQuestions questions;
  questions.arm =
      options.equations.geometry == GeometryKnowledge::kKnown &&
      std::all_of(robot.links.begin(), robot.links.end(), [](const Link& link) {
        return link.inertial.mass > 0 || IsDeclaredMassless(link);
      });
  questions.scales = questions.arm && !options.payload;
  questions.most_rows = kMostAskedRows;
  return questions;
}

bool MayBeMisread(const LogSet& training, const CalibrationDetails& details,
                  const ReadingQuestions& questions) {
  if (IsTooSlow(training)) return true;
  if (!questions.arm || !details.linear || !details.linear->solved) {
    return false;
  }
  const auto& refined = details.refined;
  if (!refined || !refined->solved || !refined->training) return true;
  return LeavesMuch(*refined->training) ||
         (questions.scales && !WhatMassesAreFar(*refined).empty()) ||
         (refined->validation && LeavesMuch(*refined->validation)) ||
         (questions.scales && HasMassesOfOtherSize(*refined));
}

}  // namespace

void TellFirst(const std::vector<DataFinding>& found, nlohmann::json* json,
               CalibrateSummary* summary) {
  std::string report, brief;
  nlohmann::json sentences = nlohmann::json::array();
  for (const DataFinding& one : found) {
    const std::string sentence =
        one.finding + ": " + one.evidence + "; " + one.flag;
    report += "warning    " + sentence + "\n";
    brief += one.finding + ". ";
    sentences.push_back(sentence);
  }
  for (const nlohmann::json& after : (*json)["warnings"]) {
    sentences.push_back(after);
  }
  (*json)["warnings"] = std::move(sentences);
  summary->report = report + summary->report;
  summary->brief = brief + summary->brief;
}

void AddLogDoubts(const Robot& robot, const LogInput& logs,
                  const CalibrateOptions& options,
                  const std::vector<DataFinding>& mended,
                  const LogSet& training, const CalibrationDetails& details,
                  nlohmann::json* json, CalibrateSummary* summary) {
  const ReadingQuestions questions = QuestionsOf(robot, options);
  std::vector<DataFinding> found = mended;
  if (MayBeMisread(training, details, questions)) {
    std::vector<LogSource> all = logs.logs;
    const std::vector<LogSource>& more = options.validation.logs;
    all.insert(all.end(), more.begin(), more.end());
    const auto wrong =
        WrongReadings(robot, Some(all), options.reading, questions);
    found.insert(found.end(), wrong.begin(), wrong.end());
  }
  if (!found.empty()) TellFirst(found, json, summary);
}

}  // namespace armcal
