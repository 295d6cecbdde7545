// write_blind_cases --set=calibration --seed=1 --cases=100 --logs=DIR
//   --labels=DIR
//
// Draws cases of the blind bench: robot files and logs go to one folder, what
// they hide to another (tests/blind/README.md).

#include <gflags/gflags.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/log_writer.h"
#include "model/plant/hidden/truth_json.h"
#include "tests/blind/blind_case.h"
#include "tests/blind/effect_size.h"

DEFINE_string(set, "calibration", "calibration, or evaluation (open it once)");
DEFINE_uint32(seed, 1, "of the set");
DEFINE_uint32(first, 0, "index of the first case");
DEFINE_uint32(cases, 100, "how many");
DEFINE_string(logs, "blind/logs", "folder for robot files and logs");
DEFINE_string(labels, "blind/labels", "folder for what they hide");
DEFINE_int32(jobs, 2, "processes");

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void WriteText(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

void WriteLog(const BlindCase& blind, BlindLog log, const fs::path& path) {
  const auto& effects =
      log == BlindLog::kReference ? std::vector<ChosenEffect>() : blind.effects;
  WriteText(path,
            LogText(RunScenario(BlindScenario(blind, log, effects)).run.log));
}

json Label(const BlindCase& blind, const ScenarioRun& training) {
  json label = TruthJson(
      BlindScenario(blind, BlindLog::kTraining, blind.effects), training);
  label["arm"] = blind.arm;
  label["excitation"] = ExcitationName(blind.excitation);
  label["motion"] = blind.points ? "points" : "fourier";
  const std::vector<EffectSize> sizes = EffectSizes(blind);
  for (size_t k = 0; k < sizes.size(); ++k) {
    json& entry = label["effects"][k];
    entry["enr"] = sizes[k].enr;
    entry["enr_raw"] = sizes[k].raw;
    entry["enr_joints"] = std::vector<double>(sizes[k].joint_enr.begin(),
                                              sizes[k].joint_enr.end());
  }
  return label;
}

// The first draw whose arm follows its motion, with its training log.
std::pair<BlindCase, ScenarioRun> DrawCase(uint64_t seed) {
  for (uint32_t attempt = 0;; ++attempt) {
    BlindCase blind = DrawBlindCase(seed, attempt);
    ScenarioRun training =
        RunScenario(BlindScenario(blind, BlindLog::kTraining, blind.effects));
    if (Follows(training.run)) return {blind, training};
  }
}

void WriteCase(BlindSet set, uint32_t index) {
  const auto& [blind, training] =
      DrawCase(BlindCaseSeed(set, FLAGS_seed, index));
  char name[32];
  std::snprintf(name, sizeof name, "case_%04u", index);
  const fs::path folder = fs::path(FLAGS_logs) / name;
  fs::create_directories(folder);
  WriteText(folder / "robot.yaml", blind.robot_yaml);
  WriteText(folder / "training.csv", LogText(training.run.log));
  WriteLog(blind, BlindLog::kValidation, folder / "validation.csv");
  if (blind.has_reference) {
    WriteLog(blind, BlindLog::kReference, folder / "reference.csv");
  }
  WriteText(folder / "case.json",
            json({{"trust", blind.trust}, {"reference", blind.has_reference}})
                    .dump(2) +
                "\n");
  WriteText(fs::path(FLAGS_labels) / (std::string(name) + ".json"),
            Label(blind, training).dump(2) + "\n");
}

int Main() {
  if (FLAGS_set != "calibration" && FLAGS_set != "evaluation") {
    std::fprintf(stderr, "--set: expected calibration or evaluation\n");
    return 2;
  }
  const BlindSet set = FLAGS_set == "calibration" ? BlindSet::kCalibration
                                                  : BlindSet::kEvaluation;
  fs::create_directories(FLAGS_logs);
  fs::create_directories(FLAGS_labels);
  for (int job = 1; job < FLAGS_jobs; ++job) {
    if (fork() != 0) continue;
    for (uint32_t k = job; k < FLAGS_cases; k += FLAGS_jobs) {
      WriteCase(set, FLAGS_first + k);
    }
    std::_Exit(0);
  }
  for (uint32_t k = 0; k < FLAGS_cases; k += FLAGS_jobs) {
    WriteCase(set, FLAGS_first + k);
  }
  int failed = 0, status = 0;
  while (wait(&status) > 0) failed += status != 0;
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  return armcal::Main();
}
