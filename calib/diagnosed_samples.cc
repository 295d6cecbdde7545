#include "calib/diagnosed_samples.h"

#include "calib/refine/robot_draws.h"
#include "calib/refine/robot_parameters.h"
#include "calib/robot_outputs.h"

namespace armcal {
namespace {

// The numbers of one robot, with their names, in the order of every other's:
// those of the robot alone, as calibrations name them, the delay, and those of
// the effects. Geometry is the file's but for what effects change of it.
EffectNumbers NumbersOf(const CorrectedRobot& corrected) {
  EffectNumbers numbers;
  const Robot& robot = corrected.plant.robot;
  const RobotParameters parameters(robot);
  for (const auto& [name, parameter] : parameters.all()) {
    if (!parameter.geometric) numbers.push_back({name, parameter.value});
  }
  numbers.push_back({"delay_s", corrected.delay});
  for (const CarriedEffect& carried : corrected.effects) {
    const Effect& effect = *carried.found.effect;
    const int j = carried.found.joint;
    std::string begin = "effects." + effect.name + ".";
    if (j >= 0) begin += robot.links[j].joint.name + ".";
    for (size_t k = 0; k < effect.parameters.size(); ++k) {
      numbers.push_back({begin + effect.parameters[k].name,
                         carried.found.p[static_cast<Eigen::Index>(k)]});
    }
  }
  return numbers;
}

std::string Table(const std::vector<CorrectedRobot>& robots) {
  RobotDraws table;
  for (size_t r = 0; r < robots.size(); ++r) {
    const EffectNumbers numbers = NumbersOf(robots[r]);
    if (r == 0) table.values.resize(numbers.size(), robots.size());
    for (size_t k = 0; k < numbers.size(); ++k) {
      if (r == 0) table.names.push_back(numbers[k].first);
      table.values(k, r) = numbers[k].second;
    }
  }
  return RobotDrawsCsv(table);
}

}  // namespace

std::string AddDiagnosedSamples(const Robot& robot,
                                const GapDiagnosis& diagnosis,
                                const RobotSource& source,
                                const std::vector<const RobotFormat*>& formats,
                                nlohmann::json* json,
                                std::vector<ResultFile>* results) {
  const auto& [robots, refusal] = diagnosis.draws;
  if (!refusal.empty()) {
    (*json)["samples"] = {{"count", 0}, {"refusal", refusal}};
    return "samples  none: " + refusal + "\n";
  }
  if (robots.empty()) return "";
  const int count = static_cast<int>(robots.size());
  results->push_back({"samples.csv", Table(robots)});
  for (int r = 0; r < count; ++r) {
    const RobotExport one = ExportCorrectedRobot(
        robots[r], robot, source.urdf.value_or(Document("")), source.base,
        formats);
    const auto add = [&](const std::string& file, const std::string& text) {
      results->push_back({SampleFile(file, r, count), text});
    };
    add("robot.urdf", one.urdf);
    for (const RobotFile& file : one.files) add(file.format->file, file.text);
    add("effects.json", one.effects.dump(2) + "\n");
  }
  return AddSamples(count, json);
}

}  // namespace armcal
