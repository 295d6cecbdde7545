// write_blind_cases --set=calibration --seed=1 --cases=100 --logs=DIR
//   --labels=DIR
//
// Draws cases of the blind bench: robot files and logs go to one folder, what
// they hide to another (tests/blind/README.md).

#include <gflags/gflags.h>
#include <glog/logging.h>
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
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  CHECK(file) << "cannot write " << path;
}

struct DrawnCase {
  BlindCase blind;
  uint32_t attempt = 0;
  ScenarioRun training, validation;
  std::vector<EffectSize> sizes;
};

ScenarioRun Run(const BlindCase& blind, BlindLog log,
                const std::vector<ChosenEffect>& effects) {
  return RunScenario(BlindScenario(blind, log, effects));
}

// The first draw whose arm follows its motions.
DrawnCase DrawCase(uint64_t seed) {
  constexpr uint32_t kMostAttempts = 100;
  for (uint32_t attempt = 0; attempt < kMostAttempts; ++attempt) {
    DrawnCase drawn;
    drawn.blind = DrawBlindCase(seed, attempt);
    drawn.attempt = attempt;
    const auto& effects = drawn.blind.effects;
    drawn.training = Run(drawn.blind, BlindLog::kTraining, effects);
    if (!Follows(drawn.training.run)) continue;
    drawn.validation = Run(drawn.blind, BlindLog::kValidation, effects);
    if (!Follows(drawn.validation.run)) continue;
    const auto sizes = EffectSizes(drawn.blind);
    if (!sizes) continue;
    drawn.sizes = *sizes;
    return drawn;
  }
  LOG(FATAL) << "case " << seed << ": its arm never follows";
  return {};
}

json Label(const DrawnCase& drawn) {
  const BlindCase& blind = drawn.blind;
  json label = TruthJson(
      BlindScenario(blind, BlindLog::kTraining, blind.effects), drawn.training);
  label["set"] = FLAGS_set;
  label["arm"] = blind.arm;
  label["excitation"] = ExcitationName(blind.excitation);
  label["motion"] = blind.points ? "points" : "fourier";
  label["reference"] = blind.has_reference;
  label["attempt"] = drawn.attempt;
  for (size_t k = 0; k < drawn.sizes.size(); ++k) {
    const EffectSize& size = drawn.sizes[k];
    json& entry = label["effects"][k];
    entry["enr"] = size.enr;
    entry["enr_raw"] = size.raw;
    entry["enr_joints"] =
        std::vector<double>(size.joint_enr.begin(), size.joint_enr.end());
  }
  return label;
}

void WriteCase(BlindSet set, uint32_t index) {
  const DrawnCase drawn = DrawCase(BlindCaseSeed(set, FLAGS_seed, index));
  const BlindCase& blind = drawn.blind;
  char name[32];
  std::snprintf(name, sizeof name, "case_%04u", index);
  const fs::path folder = fs::path(FLAGS_logs) / name;
  fs::create_directories(folder);
  WriteText(folder / "robot.yaml", blind.robot_yaml);
  WriteText(folder / "training.csv", LogText(drawn.training.run.log));
  WriteText(folder / "validation.csv", LogText(drawn.validation.run.log));
  if (blind.has_reference) {
    WriteText(folder / "reference.csv",
              LogText(Run(blind, BlindLog::kReference, {}).run.log));
  }
  WriteText(folder / "case.json",
            json({{"trust", blind.trust}, {"reference", blind.has_reference}})
                    .dump(2) +
                "\n");
  WriteText(fs::path(FLAGS_labels) / (std::string(name) + ".json"),
            Label(drawn).dump(2) + "\n");
}

// What is wrong with the flags; empty where nothing is.
std::string WhyNot() {
  if (FLAGS_set != "calibration" && FLAGS_set != "evaluation") {
    return "--set: expected calibration or evaluation";
  }
  if (FLAGS_seed >= 1u << 31) return "--seed: expected a number below 2^31";
  if (FLAGS_jobs < 1) return "--jobs: expected a number of at least 1";
  if (fs::weakly_canonical(FLAGS_logs) == fs::weakly_canonical(FLAGS_labels)) {
    return "--labels: expected another folder than --logs, whose reader must "
           "not see them";
  }
  return "";
}

int Main() {
  const std::string why = WhyNot();
  if (!why.empty()) {
    std::fprintf(stderr, "write_blind_cases: %s\n", why.c_str());
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
