#include "calib/poses/diagnosis/compliance_reader.h"

#include <algorithm>
#include <filesystem>

#include "calib/numerics/json_value.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

std::string DiagnosisFile(const std::string& path) {
  return std::filesystem::is_directory(path) ? path + "/diagnosis.json" : path;
}

// Whether an effect of logs is a spring in series with the joint: its stiffness
// is one over its parameter, a compliance.
bool GivesWay(const Effect* effect) {
  return effect != nullptr &&
         std::any_of(effect->parameters.begin(), effect->parameters.end(),
                     [](const EffectParameter& parameter) {
                       return parameter.name == "compliance";
                     });
}

Told ComplianceOf(const JsonValue& effect) {
  for (const JsonValue& estimate : effect.At("estimates").Entries()) {
    if (estimate.At("name").Text() != "stiffness") continue;
    const double stiffness = estimate.At("value").Number();
    const double stddev = estimate.At("stddev").Number();
    if (!(stiffness > 0) || !(stddev > 0)) {
      estimate.Refuse("expected a stiffness above 0 with its deviation");
    }
    return {1 / stiffness, stddev / (stiffness * stiffness)};
  }
  effect.Refuse("expected an estimate of stiffness");
}

}  // namespace

std::vector<Told> ReadCompliance(const std::string& path, const Robot& robot) {
  const std::string file = DiagnosisFile(path);
  const nlohmann::json text = ReadJson(file);
  const JsonValue root(file, "", text);
  root.At("robot").Expect(robot.name,
                          ", the robot of the poses: this is a diagnosis of "
                          "another one");
  std::vector<Told> compliance(robot.links.size());
  bool found = false;
  for (const JsonValue& effect : root.At("effects").Entries()) {
    if (!GivesWay(FindEffect(effect.At("effect").Text()))) continue;
    const long joint = effect.At("joint_index").Count();
    if (joint < 1 || joint > static_cast<long>(compliance.size())) {
      effect.At("joint_index").Refuse("expected a joint of the robot");
    }
    compliance[static_cast<size_t>(joint - 1)] = ComplianceOf(effect);
    found = true;
  }
  if (!found) {
    root.At("effects").Refuse("expected a joint that gives way among them");
  }
  return compliance;
}

}  // namespace armcal
