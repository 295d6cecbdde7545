#include "calib/diagnose/modules/effects_json.h"

#include "calib/diagnose/candidates/file_fields.h"
#include "calib/diagnose/candidates/law_share.h"
#include "calib/numerics/json_figures.h"
#include "model/robot_files/urdf_writer.h"

namespace armcal {
namespace {

using nlohmann::json;

json JointJson(const CorrectedRobot& corrected, int j) {
  const Joint& joint = corrected.plant.robot.links[j].joint;
  json coulomb = json::array();
  for (const CoulombPart& part : corrected.coulomb[j]) {
    const bool speed = part.transition.law == CoulombTransition::Law::kVelocity;
    coulomb.push_back({{"force", JsonNumber(part.force)},
                       {"width", JsonNumber(part.transition.width)},
                       {"law", speed ? "velocity" : "displacement"}});
  }
  return {{"name", joint.name},
          {"viscous", JsonNumber(joint.viscous)},
          {"offset", JsonNumber(joint.offset)},
          {"offset_in", FormatsWithOffset()},
          {"armature", JsonNumber(joint.armature)},
          {"coulomb", coulomb},
          {"effect_width", JsonNumber(corrected.width[j])}};
}

json ParametersJson(const CarriedEffect& effect, JointType type) {
  const std::vector<EffectParameter>& all = effect.found.effect->parameters;
  json parameters = json::array();
  for (size_t k = 0; k < all.size(); ++k) {
    parameters.push_back({{"name", all[k].name},
                          {"unit", ParameterUnit(all[k].unit, type)},
                          {"value", JsonNumber(effect.found.p[k])}});
  }
  return parameters;
}

json EffectJson(const CorrectedRobot& corrected, const CarriedEffect& effect) {
  const Robot& robot = corrected.plant.robot;
  const Effect& law = *effect.found.effect;
  const int j = effect.found.joint;
  const JointType type =
      j < 0 ? JointType::kRevolute : robot.links[j].joint.type;
  json numbers = json::object();
  for (const auto& [name, value] : effect.numbers) {
    numbers[name] = JsonNumber(value);
  }
  json result = {{"effect", law.name},
                 {"joint", j < 0 ? "" : robot.links[j].joint.name},
                 {"joint_index", j + 1},
                 {"law", law.law},
                 {"in_urdf", IsIn(UrdfFormat(), effect)},
                 {"in", FormatsWith(effect)},
                 {"parameters", ParametersJson(effect, type)},
                 {"numbers", numbers}};
  if (HasShare(effect)) {
    result["share"] = {{"width", JsonNumber(corrected.width[j])}};
    for (const JointTerm term :
         {JointTerm::kViscous, JointTerm::kCoulomb, JointTerm::kOffset}) {
      result["share"][JointTermName(term)] = JsonNumber(ShareOf(effect, term));
    }
  }
  return result;
}

}  // namespace

json EffectsJson(const CorrectedRobot& corrected) {
  json joints = json::array(), effects = json::array();
  for (int j = 0; j < corrected.plant.robot.num_joints(); ++j) {
    joints.push_back(JointJson(corrected, j));
  }
  for (const CarriedEffect& effect : corrected.effects) {
    effects.push_back(EffectJson(corrected, effect));
  }
  return {{"delay_s", JsonNumber(corrected.delay)},
          {"delay_in", FormatsWithDelay(corrected)},
          {"joints", joints},
          {"effects", effects}};
}

}  // namespace armcal
