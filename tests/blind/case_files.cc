#include "tests/blind/case_files.h"

#include <glog/logging.h>

#include <cstdio>
#include <fstream>

namespace armcal {

namespace fs = std::filesystem;

std::string CaseName(std::uint32_t index) {
  char name[32];
  std::snprintf(name, sizeof name, "case_%04u", index);
  return name;
}

void WriteText(const fs::path& path, const std::string& text) {
  const fs::path part = path.string() + ".part";
  std::ofstream file(part, std::ios::binary);
  file << text;
  file.close();
  CHECK(file) << "cannot write " << part;
  fs::rename(part, path);
}

std::string WhyNotWritten(const std::string& set, std::uint32_t seed,
                          const fs::path& logs, const fs::path& labels) {
  if (set != "calibration" && set != "evaluation") {
    return "--set: expected calibration or evaluation";
  }
  if (seed >= 1u << 31) return "--seed: expected a number below 2^31";
  if (fs::weakly_canonical(logs) == fs::weakly_canonical(labels)) {
    return "--labels: expected another folder than --logs, whose reader must "
           "not see them";
  }
  return "";
}

BlindSet BlindSetNamed(const std::string& name) {
  return name == "calibration" ? BlindSet::kCalibration : BlindSet::kEvaluation;
}

}  // namespace armcal
