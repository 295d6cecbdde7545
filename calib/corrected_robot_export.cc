#include "calib/corrected_robot_export.h"

#include <cmath>
#include <cstdio>

#include "calib/json_figures.h"
#include "model/urdf_update.h"
#include "model/urdf_writer.h"

namespace armcal {
namespace {

using nlohmann::json;

constexpr double kNoDelay = 1e-4;  // s, that nobody would miss

std::string Short(double x) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.4g", x);
  return text;
}

// The term of a joint that URDF has a field for and the effect adds to.
double* UrdfTerm(const GapCandidate& found, Joint* joint) {
  if (found.effect->name == "viscous_friction") return &joint->viscous;
  if (found.effect->name == "coulomb_friction") return &joint->coulomb;
  return nullptr;
}

// Friction that brakes: URDF readers refuse any other.
void ForbidPushing(const char* what, double* value, const Joint& joint,
                   std::vector<std::string>* losses) {
  if (*value >= 0) return;
  losses->push_back(std::string(what) + " friction of joint " + joint.name +
                    " was fitted as " + Short(*value) +
                    " and is 0 in the URDF, which cannot push");
  *value = 0;
}

void KeepPossibleLinks(const Robot& file, Robot* robot,
                       std::vector<std::string>* losses) {
  for (int i = 0; i < robot->num_joints(); ++i) {
    const InertialParameters& body = robot->links[i].inertial;
    if (body.ToVector().isZero(0)) continue;
    const std::string why = WhyUnphysical(body);
    if (why.empty()) continue;
    losses->push_back("link " + robot->links[i].name +
                      " keeps the file's inertia: what was fitted cannot "
                      "exist (" +
                      why + ")");
    robot->links[i].inertial = file.links[i].inertial;
  }
}

// What URDF can hold of it.
Robot UrdfRobot(const CorrectedRobot& corrected, const Robot& file,
                std::vector<std::string>* losses) {
  Robot robot = corrected.plant.robot;
  for (const CarriedEffect& effect : corrected.effects) {
    if (effect.found.joint < 0) continue;
    Joint& joint = robot.links[effect.found.joint].joint;
    double* term = UrdfTerm(effect.found, &joint);
    if (term != nullptr) *term += effect.found.p[0];
  }
  KeepPossibleLinks(file, &robot, losses);
  for (Link& link : robot.links) {
    ForbidPushing("viscous", &link.joint.viscous, link.joint, losses);
    ForbidPushing("Coulomb", &link.joint.coulomb, link.joint, losses);
  }
  return robot;
}

bool IsInUrdf(const CarriedEffect& effect) {
  Joint unused;
  return effect.in_robot || (effect.found.joint >= 0 &&
                             UrdfTerm(effect.found, &unused) != nullptr);
}

std::string Sentence(const CarriedEffect& effect, const Robot& robot) {
  std::string values;
  for (const EffectEstimate& estimate : effect.estimates) {
    values += (values.empty() ? "" : ", ") + estimate.name + " " +
              Short(estimate.value) +
              (estimate.unit == "1" ? "" : " " + estimate.unit);
  }
  const int j = effect.found.joint;
  return "URDF has no field for " + effect.found.effect->name +
         (j < 0 ? "" : " of joint " + robot.links[j].joint.name) + " (" +
         values + "): see effects.json";
}

void AddLosses(const CorrectedRobot& corrected, const Robot& robot,
               std::vector<std::string>* losses) {
  for (const std::string& loss : UrdfLosses(robot)) losses->push_back(loss);
  for (const CarriedEffect& effect : corrected.effects) {
    if (!IsInUrdf(effect)) losses->push_back(Sentence(effect, robot));
  }
  for (const std::vector<CoulombPart>& parts : corrected.coulomb) {
    if (parts.front().force == 0 && parts.size() == 1) continue;
    losses->push_back(
        "URDF has no field for how friction changes sign through zero "
        "velocity: see effects.json");
    break;
  }
  if (std::abs(corrected.delay) >= kNoDelay) {
    losses->push_back("URDF has no field for time: torque was recorded " +
                      Short(1e3 * std::abs(corrected.delay)) + " ms " +
                      (corrected.delay > 0 ? "after" : "before") +
                      " the motion");
  }
  for (const std::string& note : corrected.notes) losses->push_back(note);
}

bool SameGeometry(const Robot& a, const Robot& b) {
  for (int i = 0; i < a.num_joints(); ++i) {
    if (a.links[i].X_PF.matrix() != b.links[i].X_PF.matrix() ||
        a.links[i].X_ML.matrix() != b.links[i].X_ML.matrix()) {
      return false;
    }
  }
  return a.X_LT.matrix() == b.X_LT.matrix();
}

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
          {"armature", JsonNumber(joint.armature)},
          {"coulomb", coulomb},
          {"effect_width", JsonNumber(corrected.width[j])}};
}

json EffectJson(const CarriedEffect& effect, const Robot& robot) {
  const Effect& law = *effect.found.effect;
  const int j = effect.found.joint;
  const JointType type =
      j < 0 ? JointType::kRevolute : robot.links[j].joint.type;
  json parameters = json::array();
  for (size_t k = 0; k < law.parameters.size(); ++k) {
    parameters.push_back({{"name", law.parameters[k].name},
                          {"unit", ParameterUnit(law.parameters[k].unit, type)},
                          {"value", JsonNumber(effect.found.p[k])}});
  }
  return {{"effect", law.name},
          {"joint", j < 0 ? "" : robot.links[j].joint.name},
          {"joint_index", j + 1},
          {"law", law.law},
          {"in_urdf", IsInUrdf(effect)},
          {"parameters", parameters}};
}

}  // namespace

RobotExport ExportCorrectedRobot(const CorrectedRobot& corrected,
                                 const Robot& file, const std::string& urdf,
                                 const std::string& base) {
  RobotExport result;
  const Robot robot = UrdfRobot(corrected, file, &result.losses);
  AddLosses(corrected, robot, &result.losses);
  result.urdf = urdf.empty()
                    ? MakeUrdf(robot)
                    : UpdateUrdf(urdf, robot, !SameGeometry(robot, file), base);
  json joints = json::array(), effects = json::array();
  for (int j = 0; j < robot.num_joints(); ++j) {
    joints.push_back(JointJson(corrected, j));
  }
  for (const CarriedEffect& effect : corrected.effects) {
    effects.push_back(EffectJson(effect, robot));
  }
  result.effects = {{"delay_s", JsonNumber(corrected.delay)},
                    {"joints", joints},
                    {"effects", effects}};
  return result;
}

}  // namespace armcal
