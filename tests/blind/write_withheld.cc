// write_withheld --set=calibration --seed=1 --data=DIR --logs=DIR --labels=DIR
//
// Puts one effect each into logs of real robots, whose noise and misfit are not
// ours (tests/blind/README.md). A program of its own, which the diagnosis
// shares no formula with.

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "model/log_files/log_writer.h"
#include "model/plant/random_stream.h"
#include "model/robot_files/robot_reader.h"
#include "tests/blind/blind_program.h"
#include "tests/blind/case_files.h"
#include "tests/blind/withheld_size.h"

DEFINE_string(set, "calibration", "calibration, or evaluation (open it once)");
DEFINE_uint32(seed, 1, "of the set");
DEFINE_string(data, "../shared/data", "folder of the real logs");
DEFINE_string(logs, "withheld/logs", "folder for robot files and logs");
DEFINE_string(labels, "withheld/labels", "folder for what they hide");
DEFINE_uint32(cases, 144, "with an effect each; then every log as it is");

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kLargestEnr = 6;

// A real log and the one before it, read.
struct Source {
  RealLog real;
  Robot robot;
  Log log, reference, uniform;
  std::unique_ptr<WithheldSizer> sizer;
};

const Source& SourceOf(const RealLog& real) {
  static std::map<std::string, Source> sources;
  Source& source = sources[real.name()];
  if (source.sizer) return source;
  const fs::path folder = fs::path(FLAGS_data) / real.arm;
  source.real = real;
  source.robot = ReadRobot((folder / real.robot).string(), {});
  const auto read = [&](const std::string& file, const TimeRange& span) {
    return ReadRealLog(folder / file, span, source.robot.JointNames(),
                       real.torque_constants);
  };
  source.log = read(real.log, real.span);
  source.reference = read(real.reference, real.reference_span);
  source.uniform = UniformLog(source.log);
  source.sizer =
      std::make_unique<WithheldSizer>(source.robot, source.reference);
  return source;
}

struct SizedEffect {
  WithheldEffect effect;
  EffectSize size;
  double target = 0;
  std::string limit;  // why it has not the planned size; empty: it has
};

double DrawTarget(int bin, std::mt19937_64* random) {
  const double high = bin + 1 < kNumEnrBins ? kEnrBins[bin + 1] : kLargestEnr;
  const double margin = std::log(high / kEnrBins[bin]) / 10;
  return std::exp(std::uniform_real_distribution<double>(
      std::log(kEnrBins[bin]) + margin, std::log(high) - margin)(*random));
}

// ENR is nearly in proportion to the size.
SizedEffect AtTarget(WithheldEffect effect, double target,
                     const Source& source) {
  constexpr int kRounds = 6;
  const SizeRange range = RangeOf(effect, source.sizer->usual_torque());
  SizedEffect sized;
  sized.target = target;
  for (int round = 0; round < kRounds; ++round) {
    sized.effect = effect;
    sized.size = source.sizer->Size(effect, source.uniform);
    if (EnrBin(sized.size.enr) == EnrBin(target)) return sized;
    const double size =
        std::clamp(std::abs(effect.size) * target / sized.size.enr, range.least,
                   range.most);
    if (size == std::abs(effect.size)) break;
    effect.size = std::copysign(size, effect.size);
  }
  sized.limit = "the range of its size ends";
  return sized;
}

// On another joint, or elsewhere, where the first cannot have the size.
SizedEffect DrawSized(const std::string& name, int bin, const Source& source,
                      std::mt19937_64* random) {
  constexpr int kDraws = 4;
  const double target = DrawTarget(bin, random);
  const double duration = source.log.t[source.log.size() - 1];
  SizedEffect best;
  for (int draw = 0; draw < kDraws; ++draw) {
    const SizedEffect sized = AtTarget(
        DrawWithheldEffect(name, source.robot, source.sizer->usual_torque(),
                           duration, random),
        target, source);
    const auto distance = [target](const SizedEffect& other) {
      return std::abs(std::log(other.size.enr / target));
    };
    if (draw == 0 || distance(sized) < distance(best)) best = sized;
    if (best.limit.empty()) break;
  }
  return best;
}

json LabelOf(const Source& source, const std::vector<SizedEffect>& effects) {
  json label = {{"set", FLAGS_set},          {"stratum", "withheld"},
                {"arm", source.real.arm},    {"excitation", "rich"},
                {"log", source.real.name()}, {"reference", true},
                {"effects", json::array()}};
  for (const SizedEffect& sized : effects) {
    json values = json::array();
    for (const NamedValue& value : sized.effect.Values()) {
      values.push_back(
          {{"name", value.name}, {"unit", value.unit}, {"value", value.value}});
    }
    label["effects"].push_back({{"effect", sized.effect.name},
                                {"joint_index", sized.effect.joint + 1},
                                {"in_catalogue", true},
                                {"values", values},
                                {"enr", sized.size.enr},
                                {"enr_raw", sized.size.raw},
                                {"enr_target", sized.target},
                                {"size_limit", sized.limit}});
  }
  return label;
}

// What run_blind needs to know.
json CaseOf(const Source& source) {
  json flags = source.real.flags;
  std::string constants;
  for (const double k : source.real.torque_constants) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%g", constants.empty() ? "" : ",",
                  k);
    constants += number;
  }
  if (!constants.empty()) flags.push_back("--torque_constants=" + constants);
  return {{"robot", "robot.urdf"},
          {"reference", true},
          {"validation", false},
          {"flags", flags}};
}

void WriteCase(BlindSet set, uint32_t index) {
  const std::string name = CaseName(index);
  const fs::path label = fs::path(FLAGS_labels) / (name + ".json");
  if (fs::exists(label)) return;  // written last, so the case is complete
  std::mt19937_64 random = RandomStream(BlindCaseSeed(set, FLAGS_seed, index),
                                        0, RandomPurpose::kCase);
  const auto& names = WithheldEffectNames();
  const uint32_t kinds = static_cast<uint32_t>(names.size());
  const auto& reals = RealLogs(set);
  const uint32_t kind = index % kinds, round = index / kinds;
  const bool none = index >= FLAGS_cases;
  // Every effect as often in each of four bins of ENR, in logs by turns.
  const uint32_t which = none ? index - FLAGS_cases : kind + round + round / 4;
  const Source& source = SourceOf(reals[which % reals.size()]);
  std::vector<SizedEffect> effects;
  Log log = source.log;
  if (!none) {
    effects.push_back(DrawSized(names[kind], 1 + round % 4, source, &random));
    log = WithEffect(source.robot, effects[0].effect, log);
  }
  const fs::path folder = fs::path(FLAGS_logs) / name;
  fs::create_directories(folder);
  LogWriterOptions writer;
  writer.torque_constants = source.real.torque_constants;
  fs::copy_file(fs::path(FLAGS_data) / source.real.arm / source.real.robot,
                folder / "robot.urdf", fs::copy_options::overwrite_existing);
  WriteText(folder / "training.csv", LogText(log, writer));
  WriteText(folder / "reference.csv", LogText(source.reference, writer));
  WriteText(folder / "case.json", CaseOf(source).dump(2) + "\n");
  WriteText(label, LabelOf(source, effects).dump(2) + "\n");
}

int Main() {
  const std::string why =
      WhyNotWritten(FLAGS_set, FLAGS_seed, FLAGS_logs, FLAGS_labels);
  if (!why.empty()) {
    std::fprintf(stderr, "write_withheld: %s\n", why.c_str());
    return 2;
  }
  const BlindSet set = BlindSetNamed(FLAGS_set);
  fs::create_directories(FLAGS_logs);
  fs::create_directories(FLAGS_labels);
  const uint32_t untouched = static_cast<uint32_t>(RealLogs(set).size());
  for (uint32_t k = 0; k < FLAGS_cases + untouched; ++k) WriteCase(set, k);
  return 0;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  return armcal::RunBlindProgram("write_withheld", &armcal::Main, argc, argv);
}
