#include "calib/calibration_logs.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

#include "calib/numerics/json_value.h"
#include "calib/numerics/sha256.h"

namespace armcal {
namespace {

namespace fs = std::filesystem;

// What is known of the files that a result was made of, by path.
std::map<std::string, FileHash> Provenance(const fs::path& folder) {
  const std::string path = (folder / "provenance.json").string();
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const nlohmann::json parsed = ReadJson(path);
  std::map<std::string, FileHash> known;
  for (const JsonValue& file :
       JsonValue(path, "", parsed).At("files").Entries()) {
    known[file.At("path").Text()] = {file.At("sha256").Text(),
                                     file.At("bytes").Count()};
  }
  return known;
}

bool IsThatFile(const std::string& path, const FileHash& known) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  const auto bytes = fs::file_size(path, error);
  if (error || static_cast<long>(bytes) != known.bytes) return false;
  return HashOfFile(path).sha256 == known.sha256;
}

// A relative path is one from the folder that calibrate ran in, which is often
// this one or one that its result is in.
std::optional<std::string> FindFile(const std::string& log,
                                    const fs::path& folder,
                                    const FileHash& known) {
  fs::path from = folder;
  std::string path = log;
  for (;;) {
    if (IsThatFile(path, known)) return path;
    if (fs::path(log).is_absolute() || from == from.parent_path()) return {};
    path = (from / log).string();
    from = from.parent_path();
  }
}

}  // namespace

CalibrationLogs FindCalibrationLogs(const std::string& file,
                                    const CalibratedRobot& calibrated,
                                    const std::vector<LogSource>& used) {
  std::error_code error;
  const fs::path folder = fs::absolute(file, error).parent_path();
  const std::map<std::string, FileHash> known = Provenance(folder);
  CalibrationLogs found;
  TimeRange& crop = found.input.crop;
  crop = {std::numeric_limits<double>::infinity(), 0};
  for (size_t k = 0; k < calibrated.logs.size(); ++k) {
    const std::string& log = calibrated.logs[k];
    const auto hash = known.find(log);
    if (hash == known.end()) {
      return {{},
              "nothing beside the calibration tells which log " + log + " was"};
    }
    const std::optional<std::string> path = FindFile(log, folder, hash->second);
    if (!path) return {{}, log + " is not there as it was"};
    const TimeRange& range = calibrated.log_ranges[k];
    const auto is_this = [&](const LogSource& one) {
      return fs::equivalent(one.path(), *path, error);
    };
    if (std::any_of(used.begin(), used.end(), is_this)) continue;
    found.input.logs.push_back({log, *path});
    crop = {std::min(crop.begin, range.begin), std::max(crop.end, range.end)};
  }
  return found;
}

}  // namespace armcal
