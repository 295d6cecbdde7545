// write_equivalents [--arms=scara,elbow] [--out=tests/blind/equivalents.json]
//
// Which effects no diagnosis can tell apart on each arm of the blind bench,
// from plant signals along a rich motion of the calibration set. Run again, it
// goes on with the arms that the file lacks.

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/blind/blind_arms.h"
#include "tests/blind/blind_program.h"
#include "tests/blind/effect_likeness.h"

DEFINE_string(arms, "", "some of them; empty: all");
DEFINE_string(out, "tests/blind/equivalents.json", "added to");

namespace armcal {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// Not of any case: cases are drawn with small seeds.
constexpr uint32_t kSeed = (1u << 31) - 1;

BlindCase RichCase(const std::string& arm) {
  for (uint32_t k = 0;; ++k) {
    BlindCase blind =
        DrawBlindCase(BlindCaseSeed(BlindSet::kCalibration, kSeed, k),
                      PlanCase(Stratum::kNoneRich, 0));
    if (blind.arm != arm || blind.points) continue;
    blind.has_reference = false;
    blind.trust = .03;
    return blind;
  }
}

json PlacedJson(const NamedEffect& placed) {
  return {{"effect", placed.effect}, {"joint_index", placed.joint_index}};
}

json EquivalentsOf(const std::string& arm) {
  const BlindCase blind = RichCase(arm);
  EffectSignals signals(blind);
  int compared = 0;
  for (const ChosenEffect& effect : EveryEffect(blind)) {
    const bool added = signals.Add(effect);
    compared += added;
    if (!added) {
      std::printf("%s: nothing to compare of %s@%d\n", arm.c_str(),
                  effect.kind->name.c_str(), effect.joint + 1);
    }
  }
  json pairs = json::array();
  for (const Equivalents::Pair& pair : signals.Alike()) {
    pairs.push_back({{"a", PlacedJson(pair.a)},
                     {"b", PlacedJson(pair.b)},
                     {"cosine", std::round(1e4 * pair.cosine) / 1e4}});
  }
  std::printf("%s: %d effects, %zu pairs\n", arm.c_str(), compared,
              pairs.size());
  return pairs;
}

json ReadOut() {
  if (!fs::exists(FLAGS_out)) return json::object();
  std::ifstream file(FLAGS_out);
  return json::parse(file);
}

void Write(const json& content) {
  const std::string part = FLAGS_out + ".part";
  std::ofstream file(part);
  file << content.dump(1) << "\n";
  file.close();
  CHECK(file) << "cannot write " << part;
  fs::rename(part, FLAGS_out);
}

bool Wanted(const std::string& arm) {
  std::istringstream list(FLAGS_arms);
  for (std::string name; std::getline(list, name, ',');) {
    if (name == arm) return true;
  }
  return FLAGS_arms.empty();
}

int Main() {
  json content = ReadOut();
  for (const std::string& arm : BlindArmNames()) {
    if (!Wanted(arm) || content.contains(arm)) continue;
    content[arm] = EquivalentsOf(arm);
    Write(content);
  }
  return 0;
}

}  // namespace
}  // namespace armcal

int main(int argc, char** argv) {
  return armcal::RunBlindProgram("write_equivalents", &armcal::Main, argc,
                                 argv);
}
