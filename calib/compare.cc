#include "calib/compare.h"

#include <algorithm>

#include "calib/compare/report.h"
#include "calib/refine/calibration_reader.h"
#include "model/text/input_text.h"
#include "model/text/option_error.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

using Kind = ComparedResult::Kind;

constexpr size_t kMostResults = 26;  // a letter each
constexpr double kErrors = .01;  // of 100 pairs that agree, one is called apart

void CheckKinds(const std::vector<ComparedResult>& results) {
  for (const ComparedResult& result : results) {
    const Kind first = results[0].kind;
    const auto predicts = [](Kind kind) {
      return kind == Kind::kRobot || kind == Kind::kCalibration;
    };
    if (result.kind == first || (predicts(result.kind) && predicts(first))) {
      continue;
    }
    throw OptionError(OptionName("results") + ": found a " +
                      KindName(result.kind) + " (" + result.name +
                      ") beside a " + KindName(first) +
                      ", expected results of one kind, or robots beside "
                      "calibrations");
  }
}

// Logs of which both have some.
std::vector<std::string> Shared(const ComparedResult& a,
                                const ComparedResult& b) {
  std::vector<std::string> both;
  for (const ComparedLog& log : a.logs) {
    for (const ComparedLog& other : b.logs) {
      if (log.Overlaps(other)) both.push_back(log.file);
    }
  }
  return both;
}

// Calibrations of fewer logs than tell how much a robot changes from log to log
// may well disagree.
void AddScatterNote(Comparison* comparison) {
  constexpr size_t kEnough = 3;  // as calibrate needs
  if (comparison->agrees()) return;
  std::vector<std::string> few;
  for (const ComparedResult& result : comparison->results) {
    if (result.kind == Kind::kCalibration && result.logs.size() < kEnough) {
      few.push_back(result.name);
    }
  }
  if (few.empty()) return;
  comparison->notes.push_back(
      JoinNames(few) + (few.size() == 1 ? " is" : " are") +
      " of fewer than three logs: how much a real robot changes from log to "
      "log is not in the standard deviations; calibrate on three logs or more");
}

void ComparePairs(Comparison* comparison) {
  const auto& results = comparison->results;
  const int count = static_cast<int>(results.size());
  for (int a = 0; a < count; ++a) {
    for (int b = a + 1; b < count; ++b) {
      const Agreement& agreement =
          comparison->pairs
              .emplace_back(
                  ComparedPair{a, b,
                               CompareTwo(results[a], results[b],
                                          2 * kErrors / (count * (count - 1)))})
              .agreement;
      const bool has_values = results[a].kind == Kind::kCalibration ||
                              results[a].kind == Kind::kRobot;
      if (has_values && agreement.values.empty()) {
        throw OptionError(OptionName("results") + ": " + results[a].name +
                          " and " + results[b].name +
                          " have no parameter in common that both know");
      }
      const auto shared = Shared(results[a], results[b]);
      if (!shared.empty()) {
        comparison->notes.push_back(
            results[a].name + " and " + results[b].name + " are both of " +
            JoinNames(shared) +
            ": their errors are not independent, and differences should be "
            "smaller than the standard deviations say");
      }
      if (results[a].robot != results[b].robot) {
        comparison->notes.push_back(results[a].name + " is of a robot " +
                                    results[a].robot + ", " + results[b].name +
                                    " of " + results[b].robot);
      }
    }
  }
}

// What predicts torques on the logs.
PredictingRobot PredictingOf(const ComparedResult& result,
                             const CompareOptions& options) {
  const Robot& robot = *options.robot;
  if (result.robot_file) {
    return {result.name, *result.robot_file,
            std::vector<CoulombTransition>(robot.num_joints())};
  }
  const CalibratedRobot calibrated = ReadCalibration(result.file, robot);
  return {result.name, calibrated.robot, calibrated.transitions};
}

void CompareHeldOut(const CompareOptions& options, Comparison* comparison) {
  if (options.logs.logs.empty()) return;
  std::vector<PredictingRobot> robots;
  for (const ComparedResult& result : comparison->results) {
    if (result.kind != Kind::kRobot && result.kind != Kind::kCalibration) {
      throw OptionError(OptionName("log") + ": found it with a " +
                        std::string(KindName(result.kind)) +
                        ", expected calibrations or robots, which predict "
                        "torques");
    }
    robots.push_back(PredictingOf(result, options));
    for (const LogSource& log : options.logs.logs) {
      const ComparedLog held_out{log.name, options.logs.crop.begin,
                                 options.logs.crop.end};
      if (std::any_of(result.logs.begin(), result.logs.end(),
                      [&](const ComparedLog& seen) {
                        return seen.Overlaps(held_out);
                      })) {
        comparison->notes.push_back(result.name + " was calibrated on " +
                                    log.name + ", which is not held out");
      }
    }
  }
  comparison->held_out = CompareOnLogs(
      robots, options.bandwidth_hz, options.progress,
      LogSet(options.logs.logs, options.reading, options.logs.crop));
}

}  // namespace

CompareSummary Compare(const std::vector<std::string>& results,
                       const CompareOptions& options) {
  if (results.size() < 2) {
    throw OptionError(OptionName("results") +
                      ": expected two results or more, files or folders");
  }
  if (results.size() > kMostResults) {
    throw OptionError(OptionName("results") + ": found " +
                      std::to_string(results.size()) + " results, expected " +
                      std::to_string(kMostResults) + " at most");
  }
  Comparison comparison;
  comparison.errors = kErrors;
  for (const std::string& path : results) {
    comparison.results.push_back(ReadResult(path, options.read_robot));
  }
  CheckKinds(comparison.results);
  ComparePairs(&comparison);
  AddScatterNote(&comparison);
  CompareHeldOut(options, &comparison);
  CompareSummary summary;
  summary.robot = comparison.results[0].robot;
  summary.positive = comparison.agrees();
  summary.brief = BriefText(comparison);
  for (const std::string& note : comparison.notes) {
    summary.report += "note: " + note + "\n";
  }
  summary.report += ToText(comparison);
  summary.json = ToJson(comparison).dump(2) + "\n";
  summary.files = {{"comparison.json", summary.json}};
  return summary;
}

}  // namespace armcal
