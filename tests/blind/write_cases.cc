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
#include <nlohmann/json.hpp>

#include "model/log_files/log_writer.h"
#include "model/plant/hidden/truth_json.h"
#include "model/text/input_text.h"
#include "tests/blind/blind_program.h"
#include "tests/blind/case_files.h"
#include "tests/blind/sized_case.h"

DEFINE_string(set, "calibration", "calibration, or evaluation (open it once)");
DEFINE_uint32(seed, 1, "of the set");
DEFINE_uint32(first, 0, "index of the first case");
DEFINE_uint32(cases, 100, "how many");
DEFINE_string(plan, "evaluation",
              "all strata in their shares, or one of them: none_rich, "
              "none_poor, one, two, outside; or an effect of the catalogue, as "
              "stratum one has it");
DEFINE_string(logs, "blind/logs", "folder for robot files and logs");
DEFINE_bool(torques, true,
            "false: logs hold times, positions and commands alone, the "
            "diagnoser is told the controller, and visibility (enr) is that on "
            "positions; the robots are the same");
DEFINE_bool(misfit, false,
            "true: each robot also has what no model of it has: another law of "
            "friction at zero velocity, ripple, torque constants that are off, "
            "drift; the robots and their effects are the same");
DEFINE_string(quiet, "",
              "folder for held-out motion without noise of cases with effects; "
              "empty: none");
DEFINE_string(labels, "blind/labels", "folder for what they hide");
DEFINE_int32(jobs, 2, "processes");

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<double> Numbers(const Eigen::VectorXd& x) {
  return {x.begin(), x.end()};
}

json OracleJson(const OracleGap& gap) {
  return {{"nominal", Numbers(gap.nominal)},
          {"refit", Numbers(gap.refit)},
          {"after", Numbers(gap.after)},
          {"floor", Numbers(gap.floor)},
          {"removed_percent", gap.RemovedPercent()},
          {"removed_from_nominal_percent", gap.RemovedFromNominalPercent()}};
}

// How visible the effects are in what is logged.
std::vector<EffectSize> SizesAsLogged(const SizedCase& sized) {
  if (sized.blind.has_torque || sized.sizes.empty()) return sized.sizes;
  BlindCase planned = sized.blind;
  planned.misfit.reset();
  const auto sizes = EffectSizes(planned);
  CHECK(sizes) << "an arm that has followed follows";
  return *sizes;
}

json MisfitJson(const BlindCase& blind) {
  std::vector<std::string> logs = {"training", "validation"};
  if (blind.has_reference) logs.push_back("reference");  // as BlindLog has them
  return ToJson(*blind.misfit, logs);
}

// Of what truth.json says of effect k, and what the bench knows of it.
void AddSize(const SizedCase& sized, const EffectSize& size, size_t k,
             json* entry) {
  const SizeAim& aim = sized.blind.aims[k];
  (*entry)["enr"] = size.enr;
  (*entry)["enr_torque"] = sized.sizes[k].enr;
  (*entry)["enr_raw"] = size.raw;
  (*entry)["enr_joints"] = Numbers(size.joint_enr);
  (*entry)["enr_target"] = aim.target;
  (*entry)["size_limit"] = sized.limits[k];
}

json Label(const SizedCase& sized) {
  const BlindCase& blind = sized.blind;
  json label = TruthJson(
      BlindScenario(blind, BlindLog::kTraining, blind.effects), sized.training);
  label["set"] = FLAGS_set;
  label["stratum"] = StratumName(blind.plan.stratum);
  label["arm"] = blind.arm;
  label["excitation"] = ExcitationName(blind.plan.excitation);
  label["motion"] = blind.points ? "points" : "fourier";
  label["reference"] = blind.has_reference;
  label["attempt"] = sized.attempt;
  if (blind.misfit) label["misfit"] = MisfitJson(blind);
  const std::vector<EffectSize> sizes = SizesAsLogged(sized);
  for (size_t k = 0; k < sizes.size(); ++k) {
    AddSize(sized, sizes[k], k, &label["effects"][k]);
  }
  if (sized.oracle) label["oracle"] = OracleJson(*sized.oracle);
  return label;
}

std::string CaseLog(const BlindCase& blind, const ScenarioRun& run) {
  Log log = run.run.log;
  if (!blind.has_torque) {
    log.qd.resize(0, 0);
    log.qdd.resize(0, 0);
    log.tau.resize(0, 0);
  }
  return LogText(log);
}

// Where it does not follow its motion as the noisy arm does, there is none.
void WriteQuiet(const BlindCase& blind, const std::string& name) {
  if (FLAGS_quiet.empty() || blind.effects.empty()) return;
  const ScenarioRun quiet =
      RunScenario(QuietScenario(blind, BlindLog::kValidation, blind.effects));
  if (!Follows(quiet.run)) return;
  const fs::path folder = fs::path(FLAGS_quiet) / name;
  fs::create_directories(folder);
  WriteText(folder / "validation.csv", CaseLog(blind, quiet));
}

// As BlindScenario has it; its gains are of the robot file.
std::string ControllerText() {
  return "law: pd\nbandwidth: " + NumberText(kUsualBandwidthHz) + "\n";
}

ScenarioRun Reference(const BlindCase& blind) {
  return RunScenario(BlindScenario(blind, BlindLog::kReference, {}));
}

// As --plan says.
CasePlan Plan(uint32_t index) {
  const auto stratum = StratumOf(FLAGS_plan);
  const HiddenEffect* const effect = FindHiddenEffect(FLAGS_plan);
  if (effect != nullptr) return PlanCase(*effect, index);
  return stratum ? PlanCase(*stratum, index) : PlanCase(index);
}

void WriteCase(BlindSet set, uint32_t index) {
  const std::string name = CaseName(index);
  const fs::path label = fs::path(FLAGS_labels) / (name + ".json");
  if (fs::exists(label)) return;  // written last, so the case is complete
  SizedCase sized =
      DrawSizedCase(BlindCaseSeed(set, FLAGS_seed, index), Plan(index));
  sized.blind.has_torque = FLAGS_torques;
  if (FLAGS_misfit) AddMisfit(&sized);
  const BlindCase& blind = sized.blind;
  const fs::path folder = fs::path(FLAGS_logs) / name;
  fs::create_directories(folder);
  WriteText(folder / "robot.yaml", blind.robot_yaml);
  WriteText(folder / "training.csv", CaseLog(blind, sized.training));
  WriteText(folder / "validation.csv", CaseLog(blind, sized.validation));
  if (blind.has_reference) {
    WriteText(folder / "reference.csv", CaseLog(blind, Reference(blind)));
  }
  WriteQuiet(blind, name);
  json told = {{"trust", blind.trust}, {"reference", blind.has_reference}};
  if (!blind.has_torque) {
    WriteText(folder / "controller.yaml", ControllerText());
    told["flags"] = {"--controller=controller.yaml"};
  }
  WriteText(folder / "case.json", told.dump(2) + "\n");
  WriteText(label, Label(sized).dump(2) + "\n");
}

// What is wrong with the flags; empty where nothing is.
std::string WhyNot() {
  const HiddenEffect* const effect = FindHiddenEffect(FLAGS_plan);
  if (FLAGS_plan != "evaluation" && !StratumOf(FLAGS_plan) &&
      (effect == nullptr || !effect->in_catalogue)) {
    return "--plan: expected evaluation, none_rich, none_poor, one, two, "
           "outside or an effect of the catalogue";
  }
  if (FLAGS_jobs < 1) return "--jobs: expected a number of at least 1";
  return WhyNotWritten(FLAGS_set, FLAGS_seed, FLAGS_logs, FLAGS_labels);
}

int Main() {
  const std::string why = WhyNot();
  if (!why.empty()) {
    std::fprintf(stderr, "write_blind_cases: %s\n", why.c_str());
    return 2;
  }
  const BlindSet set = BlindSetNamed(FLAGS_set);
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
  return armcal::RunBlindProgram("write_blind_cases", &armcal::Main, argc,
                                 argv);
}
