#include "calib/merge.h"

#include <filesystem>
#include <set>
#include <utility>

#include "calib/fleet/combine.h"
#include "calib/fleet/factor_calibration.h"
#include "calib/fleet/factor_file.h"
#include "calib/fleet/factor_report.h"
#include "calib/fleet/report.h"
#include "calib/linear/calibration_report.h"
#include "calib/linear/verdict.h"
#include "model/text/input_error.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

// Folders stand for the factor files in them.
std::vector<std::string> FactorFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
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

Reduction ReadFactors(const Robot& robot, const std::vector<std::string>& paths,
                      const MergeOptions& options) {
  std::vector<std::pair<std::string, Reduction>> parts;
  const std::vector<std::string> files = FactorFiles(paths);
  for (const std::string& file : files) {
    if (options.progress) {
      options.progress("reading factors",
                       static_cast<double>(parts.size()) /
                           static_cast<double>(files.size()));
    }
    parts.emplace_back(file, ReadFactorFile(file));
  }
  Reduction all = Combine(parts);
  const std::string& sha256 = options.source.sha256;
  if (!sha256.empty() && all.model.robot_sha256 != sha256) {
    throw InputError(files[0], "key model.robot_sha256", all.model.robot_sha256,
                     "expected " + sha256 + ", that of " + options.source.name);
  }
  ParametersOf(robot, all.model, files[0]);
  return all;
}

// fleet.json and its text, where logs say what units they are of.
void AddFleet(const Robot& robot, const Reduction& reduction,
              const LinearCalibration& pooled, const Progress& progress,
              Summary* summary) {
  const auto units = static_cast<int>(UnitNames(reduction).size());
  if (units < 2 || !pooled.solved) return;
  if (units < kLeastUnits) {
    summary->report += "no fleet: " + std::to_string(units) +
                       " units do not tell how units spread; " +
                       std::to_string(kLeastUnits) + " do\n";
    return;
  }
  const FleetOptions options;
  const FleetCalibration fleet =
      CalibrateFleet(robot, reduction, pooled, options, progress);
  summary->report += FleetText(robot, pooled, fleet, options);
  summary->files.push_back(
      {"fleet.json", ToJson(robot, pooled, fleet, options).dump(2) + "\n"});
}

}  // namespace

MergeSummary Merge(const Robot& robot, const std::vector<std::string>& factors,
                   const MergeOptions& options) {
  const Reduction reduction = ReadFactors(robot, factors, options);
  if (options.progress) options.progress("solving", -1);
  const LinearCalibration result = CalibrateFromFactors(robot, reduction);
  MergeSummary summary;
  summary.solved = result.solved;
  summary.brief = BriefReport(robot, reduction, result);
  summary.json = ToJson(robot, reduction, result).dump(2) + "\n";
  summary.report = FullReport(robot, reduction, result);
  summary.files = {{"calibration.json", summary.json},
                   {"covariance.csv", CovarianceCsv(result)},
                   {"merged.factor", FactorFileBytes(reduction)}};
  AddFleet(robot, reduction, result, options.progress, &summary);
  summary.positive = Shortcomings(robot, result).empty();
  return summary;
}

}  // namespace armcal
