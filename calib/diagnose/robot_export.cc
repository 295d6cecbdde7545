#include "calib/diagnose/robot_export.h"

#include <cmath>
#include <cstdio>

#include "calib/diagnose/candidates/dry_friction.h"
#include "calib/diagnose/candidates/file_fields.h"
#include "calib/diagnose/candidates/law_share.h"
#include "calib/diagnose/modules/effects_json.h"
#include "calib/refine/possible_links.h"
#include "model/robot_files/urdf_update.h"
#include "model/robot_files/urdf_writer.h"

namespace armcal {
namespace {

using nlohmann::json;

std::string Short(double x) {
  char text[40];
  std::snprintf(text, sizeof(text), "%.4g", x);
  return text;
}

// Friction that brakes: URDF readers refuse any other.
void ForbidPushing(const char* what, double* value, const Joint& joint,
                   std::vector<std::string>* losses) {
  if (*value >= 0) return;
  losses->push_back(std::string(what) + " friction of joint " + joint.name +
                    " was fitted as " + Short(*value) +
                    " and is 0 in the file, which cannot push");
  *value = 0;
}

// Which links cannot exist, and why.
std::string Impossible(const Robot& robot) {
  std::string text;
  for (const Link& link : robot.links) {
    const InertialParameters& body = link.inertial;
    if (body.ToVector().isZero(0)) continue;
    const std::string why = WhyUnphysical(body);
    if (why.empty()) continue;
    text += (text.empty() ? "" : "; ") + link.name + ": " + why;
  }
  return text;
}

void KeepFileLinks(const Robot& file, Robot* robot) {
  for (int i = 0; i < robot->num_joints(); ++i) {
    const InertialParameters& body = robot->links[i].inertial;
    if (body.ToVector().isZero(0) || WhyUnphysical(body).empty()) continue;
    robot->links[i].inertial = file.links[i].inertial;
  }
}

// Simulators take bodies that can exist only. A motor on a spring keeps its
// inertia.
void MakeLinksPossible(const CorrectedRobot& corrected, const Robot& file,
                       Robot* robot, std::vector<std::string>* losses) {
  const std::string why = Impossible(*robot);
  if (why.empty()) return;
  std::vector<bool> free_armature(robot->num_joints(), true);
  for (const Transmission& law : corrected.plant.transmissions) {
    free_armature[law.joint] = false;
  }
  const auto possible =
      FindPossibleLinks(*robot, file, corrected.scale, free_armature);
  if (!possible || !Impossible(possible->robot).empty()) {
    KeepFileLinks(file, robot);
    losses->push_back(
        "links keep the file's inertia where what was fitted "
        "cannot exist (" +
        why + ")");
    return;
  }
  *robot = possible->robot;
  std::string differs;
  for (int j = 0; j < robot->num_joints(); ++j) {
    differs += (j == 0 ? "" : ", ") + robot->links[j].joint.name + " " +
               Short(possible->differs_percent[j]) + " %";
  }
  losses->push_back("what was fitted cannot exist (" + why +
                    "): the links are the nearest that can, whose torques in "
                    "motion like the log's differ by (rms) " +
                    differs);
}

// How friction changes sign, with what of it is another law's share, and the
// delay by which torque acts late.
void SetLaws(const CorrectedRobot& corrected, RobotDescription* description) {
  for (int j = 0; j < description->robot.num_joints(); ++j) {
    double* const dry = &description->robot.links[j].joint.coulomb;
    std::vector<CoulombPart> coulomb = corrected.coulomb[j];
    double share = *dry;
    for (const CoulombPart& part : coulomb) share -= part.force;
    const double width = corrected.width[j];
    coulomb.push_back({share, {CoulombTransition::Law::kVelocity, width}});
    *dry = SetDryFriction(coulomb, width, &description->drives[j]);
  }
  if (corrected.acts_late()) description->torque_delay = -corrected.delay;
}

// What the format can hold of it.
RobotDescription Describe(const CorrectedRobot& corrected, const Robot& file,
                          const RobotFormat& format,
                          std::vector<std::string>* losses) {
  RobotDescription description{corrected.plant.robot, {}};
  Robot& robot = description.robot;
  description.drives.resize(robot.num_joints());
  for (const CarriedEffect& effect : corrected.effects) {
    const int j = effect.found.joint;
    if (j < 0 || effect.in_robot) continue;
    if (IsIn(format, effect)) {
      AddToFile(effect, &robot.links[j].joint, &description.drives[j]);
    } else {
      for (const JointTerm term : effect.found.effect->stand_ins) {
        *TermOf(term, &robot.links[j].joint) += ShareOf(effect, term);
      }
    }
  }
  MakeLinksPossible(corrected, file, &robot, losses);
  for (Link& link : robot.links) {
    ForbidPushing("viscous", &link.joint.viscous, link.joint, losses);
    ForbidPushing("Coulomb", &link.joint.coulomb, link.joint, losses);
    ForbidPushing("armature", &link.joint.armature, link.joint, losses);
  }
  if (format.Holds(RobotField::kLaws)) SetLaws(corrected, &description);
  return description;
}

std::string Sentence(const RobotFormat& format, const CarriedEffect& effect,
                     const Robot& robot) {
  std::string values;
  for (const EffectEstimate& estimate : effect.estimates) {
    values += (values.empty() ? "" : ", ") + estimate.name + " " +
              Short(estimate.value) +
              (estimate.unit == "1" ? "" : " " + estimate.unit);
  }
  const int j = effect.found.joint;
  return std::string(format.title) + " has no field for " +
         effect.found.effect->name +
         (j < 0 ? "" : " of joint " + robot.links[j].joint.name) + " (" +
         values + "): see effects.json";
}

// What stands in the file in the effect's stead; empty where nothing does.
std::string ShareSentence(const RobotFormat& format,
                          const CarriedEffect& effect, const Robot& robot) {
  if (IsIn(format, effect) || !HasShare(effect)) return "";
  const Joint& joint = robot.links[effect.found.joint].joint;
  std::string terms;
  for (const JointTerm term : effect.found.effect->stand_ins) {
    if (term == JointTerm::kOffset && !format.Holds(RobotField::kOffset)) {
      continue;
    }
    terms += (terms.empty() ? "" : ", ") + std::string(JointTermName(term)) +
             " " + Short(ShareOf(effect, term)) + " " +
             JointTermUnit(term, joint.type);
  }
  if (terms.empty()) return "";
  return "the mean of " + effect.found.effect->name +
         " over the log is in joint " + joint.name + " of the file (" + terms +
         ")";
}

// For those who have the file alone.
std::string Commented(const RobotFormat& format, const std::string& text,
                      const CorrectedRobot& corrected) {
  std::vector<std::string> sentences;
  for (const CarriedEffect& effect : corrected.effects) {
    const std::string sentence =
        ShareSentence(format, effect, corrected.plant.robot);
    if (!sentence.empty()) sentences.push_back(sentence);
  }
  return WithComment(format, text, sentences);
}

void AddLosses(const CorrectedRobot& corrected, const RobotFormat& format,
               const RobotDescription& description,
               std::vector<std::string>* losses) {
  const std::string title = format.title;
  for (const std::string& loss : Losses(format, description)) {
    losses->push_back(loss);
  }
  for (const CarriedEffect& effect : corrected.effects) {
    if (IsIn(format, effect)) continue;
    const std::string share = ShareSentence(format, effect, description.robot);
    losses->push_back(Sentence(format, effect, description.robot) +
                      (share.empty() ? "" : "; " + share));
  }
  const bool laws = format.Holds(RobotField::kLaws);
  for (const std::vector<CoulombPart>& parts : corrected.coulomb) {
    if (laws) break;
    if (parts.front().force == 0 && parts.size() == 1) continue;
    losses->push_back(title +
                      " has no field for how friction changes sign through "
                      "zero velocity: see effects.json");
    break;
  }
  if (corrected.has_delay() && !(laws && corrected.acts_late())) {
    losses->push_back(title + " has no field for time: torque was recorded " +
                      Short(1e3 * std::abs(corrected.delay)) + " ms " +
                      (corrected.delay > 0 ? "after" : "before") +
                      " the motion");
  }
  for (const std::string& note : corrected.notes) losses->push_back(note);
}

RobotFile MakeFile(const CorrectedRobot& corrected, const Robot& file,
                   const RobotFormat& format) {
  RobotFile result{&format, "", {}};
  const RobotDescription description =
      Describe(corrected, file, format, &result.losses);
  AddLosses(corrected, format, description, &result.losses);
  result.text = Commented(format, format.write(description), corrected);
  return result;
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

}  // namespace

nlohmann::json RobotFilesJson(const std::vector<RobotFile>& files) {
  json list = json::array();
  for (const RobotFile& file : files) {
    list.push_back({{"format", file.format->name},
                    {"file", file.format->file},
                    {"losses", file.losses}});
  }
  return list;
}

RobotExport ExportCorrectedRobot(
    const CorrectedRobot& corrected, const Robot& file, const Document& urdf,
    const std::string& base, const std::vector<const RobotFormat*>& formats) {
  RobotExport result;
  const bool is_new = urdf.name().empty();
  const RobotFormat of_urdf = is_new ? UrdfFormat() : UpdatedUrdfFormat();
  const RobotDescription description =
      Describe(corrected, file, of_urdf, &result.losses);
  const Robot& robot = description.robot;
  AddLosses(corrected, of_urdf, description, &result.losses);
  const std::string text =
      is_new ? MakeUrdf(robot)
             : UpdateUrdf(urdf, robot, !SameGeometry(robot, file), base,
                          &result.losses);
  result.urdf = Commented(of_urdf, text, corrected);
  for (const RobotFormat* format : formats) {
    result.files.push_back(MakeFile(corrected, file, *format));
  }
  result.effects = EffectsJson(corrected);
  return result;
}

}  // namespace armcal
