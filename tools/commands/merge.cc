#include "tools/commands/merge.h"

#include <gflags/gflags.h>

#include <filesystem>
#include <set>

#include "calib/fleet/combine.h"
#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/factor_file.h"
#include "calib/fleet/factor_report.h"
#include "calib/fleet/report.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/verdict.h"
#include "model/text/input_error.h"
#include "tools/input_flags.h"
#include "tools/report/report_page.h"

DEFINE_string(factors, "",
              "`FILES` factor files of armcal reduce A[,B..], or folders of "
              "them");

namespace armcal {
namespace {

namespace fs = std::filesystem;

// Folders stand for the factor files in them.
std::vector<std::string> FactorsFromFlags(const FlagValues& flags) {
  if (flags.Text("factors").empty())
    throw UsageError("--factors=FILES is needed");
  std::vector<std::string> files;
  for (const std::string& path : SplitAtCommas(flags.Text("factors"))) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(path)) {
      if (entry.path().extension() == ".factor") {
        found.insert(entry.path().string());
      }
    }
    if (found.empty()) {
      throw InputError(path, "", "", "holds no .factor files");
    }
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

Reduction ReadFactors(const CommandInput& input, const Robot& robot) {
  const Progress& progress = input.progress;
  std::vector<std::pair<std::string, Reduction>> parts;
  const std::vector<std::string> files = FactorsFromFlags(input.flags);
  for (const std::string& file : files) {
    if (progress) {
      progress("reading factors", static_cast<double>(parts.size()) /
                                      static_cast<double>(files.size()));
    }
    parts.emplace_back(file, ReadFactorFile(file));
  }
  Reduction all = Combine(parts);
  const std::string sha256 = HashDocument(RobotFileFromFlags(input)).sha256;
  if (all.model.robot_sha256 != sha256) {
    throw InputError(
        files[0], "key model.robot_sha256", all.model.robot_sha256,
        "expected " + sha256 + ", that of " + RobotFileFromFlags(input).name());
  }
  ParametersOf(robot, all.model, files[0]);
  return all;
}

// fleet.json and its text, where logs say what units they are of.
void AddFleet(const Robot& robot, const Reduction& reduction,
              const LinearCalibration& pooled, const Progress& progress,
              CommandOutcome* outcome) {
  const auto units = static_cast<int>(UnitNames(reduction).size());
  if (units < 2 || !pooled.solved) return;
  if (units < kLeastUnits) {
    outcome->output.text += "no fleet: " + std::to_string(units) +
                            " units do not tell how units "
                            "spread; " +
                            std::to_string(kLeastUnits) + " do\n";
    return;
  }
  const FleetOptions options;
  const FleetCalibration fleet =
      CalibrateFleet(robot, reduction, pooled, options, progress);
  outcome->output.text += FleetText(robot, pooled, fleet, options);
  outcome->folders[0].Add("fleet.json",
                          ToJson(robot, pooled, fleet, options).dump(2) + "\n");
}

CommandOutcome RunMerge(const CommandInput& input) {
  const Robot robot = RobotFromFlags(input);
  const Reduction reduction = ReadFactors(input, robot);
  input.Begin("solving");
  const LinearCalibration result = CalibrateFromFactors(robot, reduction);
  CommandOutcome outcome;
  outcome.brief = BriefReport(robot, reduction, result);
  outcome.output.json = ToJson(robot, reduction, result).dump(2) + "\n";
  outcome.output.text = FullReport(robot, reduction, result);
  OutputFolder& out = outcome.folders.emplace_back(OutFromFlags(input.flags));
  out.Add("calibration.json", outcome.output.json);
  out.Add("covariance.csv", CovarianceCsv(result));
  out.Add("merged.factor", FactorFileBytes(reduction));
  AddFleet(robot, reduction, result, input.progress, &outcome);
  outcome.output.verdict = robot.name + ": ";
  outcome.output.positive = Shortcomings(robot, result).empty();
  outcome.output.notes = robot.notes;
  return outcome;
}

}  // namespace

Command MergeCommand() {
  return {"merge",
          "factor files to a calibration, and what the units of one robot "
          "have in common, differ in and drift by",
          {{"robot and factors", {"robot", "factors"}}, ChainFlags()},
          {"armcal merge --robot=arm.urdf --factors=mon.factor,tue.factor",
           "armcal merge --robot=arm.urdf --factors=factors --out=merged"},
          &RunMerge};
}

}  // namespace armcal
