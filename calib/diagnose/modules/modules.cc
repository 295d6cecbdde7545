#include "calib/diagnose/modules/modules.h"

#include <cmath>

#include "calib/diagnose/modules/c_data.h"
#include "calib/diagnose/modules/module_test.h"
#include "calib/numerics/json_figures.h"
#include "model/text/format.h"

extern "C" {
extern const char embedded_effects_py[], embedded_effects_py_end[];
extern const char embedded_effects_c[], embedded_effects_c_end[];
extern const char embedded_effects_h[], embedded_effects_h_end[];
}

namespace armcal {
namespace {

using Eigen::VectorXd;
using nlohmann::json;
using Step = ModuleTest::Step;

json List(const VectorXd& x) {
  json list = json::array();
  for (const double value : x) list.push_back(JsonNumber(value));
  return list;
}

json TestJson(const ModuleTest& test) {
  json steps = json::array();
  for (const Step& step : test.steps) {
    steps.push_back({{"q", List(step.q)},
                     {"qd", List(step.qd)},
                     {"commanded", List(step.commanded)},
                     {"load", nullptr},
                     {"reading", List(step.reading)},
                     {"torque", List(step.torque)},
                     {"damping", List(step.damping)},
                     {"undamped", List(step.undamped)}});
    if (step.load.size() > 0) steps.back()["load"] = List(step.load);
  }
  return {{"dt", test.dt},
          {"t", test.t},
          {"warmth", List(test.warmth)},
          {"load", List(test.load)},
          {"largest",
           {{"reading", test.LargestOf(&Step::reading)},
            {"torque", test.LargestOf(&Step::torque)},
            {"damping", test.LargestOf(&Step::damping)},
            {"undamped", test.LargestOf(&Step::undamped)}}},
          {"steps", steps}};
}

std::string OfJoint(const CorrectedRobot& robot, int j) {
  return j < 0 ? "" : " of joint " + robot.plant.robot.links[j].joint.name;
}

std::vector<std::string> ModuleLosses(const CorrectedRobot& robot) {
  std::vector<std::string> losses;
  for (const CarriedEffect& effect : robot.effects) {
    if (effect.in_robot || effect.in_delay || !effect.numbers.empty()) continue;
    losses.push_back("the module has no law for " + effect.found.effect->name +
                     OfJoint(robot, effect.found.joint));
  }
  for (const Transmission& law : robot.plant.transmissions) {
    const Joint& joint = robot.plant.robot.links[law.joint].joint;
    losses.push_back(
        Format("the module moves the motor of joint %s (armature %.4g): the "
               "simulator's joint is to have no armature, damping or dry "
               "friction",
               joint.name.c_str(), joint.armature));
  }
  if (robot.delay > 0 && robot.has_delay()) {
    losses.push_back(
        Format("torques were recorded %.4g ms after they acted: the module "
               "gives them at once, and a log of them is to be that much later",
               1e3 * robot.delay));
  }
  for (const std::string& note : robot.notes) losses.push_back(note);
  return losses;
}

}  // namespace

const std::vector<std::string>& EffectModuleNames() {
  static const auto* const names = new std::vector<std::string>{"python", "c"};
  return *names;
}

std::vector<EffectModule> MakeEffectModules(
    const CorrectedRobot& robot, const std::vector<std::string>& names) {
  std::vector<EffectModule> modules;
  if (names.empty()) return modules;
  const ModuleTest test = MakeModuleTest(robot);
  for (const std::string& name : names) {
    EffectModule module{name, {}, ModuleLosses(robot)};
    if (name == "c") {
      module.files = {
          {"effects.c", {embedded_effects_c, embedded_effects_c_end}},
          {"effects.h", {embedded_effects_h, embedded_effects_h_end}},
          {"effects_data.h", CData(robot, test)}};
    } else {
      module.files = {
          {"effects.py", {embedded_effects_py, embedded_effects_py_end}},
          {"effects_test.json", TestJson(test).dump() + "\n"}};
    }
    modules.push_back(module);
  }
  return modules;
}

json EffectModulesJson(const std::vector<EffectModule>& modules) {
  json list = json::array();
  for (const EffectModule& module : modules) {
    json files = json::array();
    for (const auto& [name, text] : module.files) files.push_back(name);
    list.push_back(
        {{"module", module.name}, {"files", files}, {"losses", module.losses}});
  }
  return list;
}

}  // namespace armcal
