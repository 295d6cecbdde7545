#include "calib/diagnose/modules/c_data.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <vector>

#include "calib/diagnose/candidates/file_fields.h"
#include "calib/diagnose/candidates/law_share.h"
#include "model/effects/effects.h"
#include "model/robot_files/robot_formats.h"
#include "model/text/exact_text.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

std::string Upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::toupper(c); });
  return text;
}

// With an exponent or a point, as C has it of a double; 0 of what is none.
std::string Literal(double x) {
  if (!std::isfinite(x)) return "0.";
  const std::string text = ExactText(x);
  const bool is_double = text.find_first_of(".e") != std::string::npos;
  return is_double ? text : text + ".";
}

std::string Literals(const VectorXd& x) {
  std::string text;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    text += (i == 0 ? "{" : ", ") + Literal(x[i]);
  }
  return text.empty() ? "{0.}" : text + "}";
}

// A C string.
std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c < ' ' ? ' ' : static_cast<char>(c);
  }
  return quoted + "\"";
}

std::string Mask(const std::vector<std::string>& formats) {
  std::string mask;
  for (const std::string& format : formats) {
    mask += (mask.empty() ? "" : " | ") + ("EFFECTS_IN_" + Upper(format));
  }
  return mask.empty() ? "0" : mask;
}

// A line of the table of laws.
std::string Law(const std::string& kind, int joint, const std::string& mask,
                const VectorXd& numbers, int neighbour = 0,
                const std::string& share = "{0., 0., 1., 0.}") {
  return "  {EFFECTS_" + kind + ", " + std::to_string(joint) + ", " +
         std::to_string(neighbour) + ", " + mask + ", " + share + ", " +
         Literals(numbers) + "},\n";
}

std::string OwnLaws(const CorrectedRobot& robot, int j) {
  const Joint& joint = robot.plant.robot.links[j].joint;
  const std::string all = "EFFECTS_IN_ALL";
  std::string lines =
      Law("VISCOUS_FRICTION", j, all, VectorXd::Constant(1, joint.viscous));
  for (const CoulombPart& part : robot.coulomb[j]) {
    const bool speed = part.transition.law == CoulombTransition::Law::kVelocity;
    lines += Law(speed ? "COULOMB_FRICTION" : "YIELDING_FRICTION", j, all,
                 Eigen::Vector2d(part.force, part.transition.width));
  }
  if (joint.offset == 0) return lines;
  return lines + Law("CONSTANT", j, Mask(FormatsWithOffset()),
                     VectorXd::Constant(1, joint.offset));
}

// Empty where the module does not hold it.
std::string EffectLaw(const CorrectedRobot& robot,
                      const CarriedEffect& effect) {
  const int j = effect.found.joint;
  if (j < 0 || effect.numbers.empty()) return "";
  VectorXd numbers(effect.numbers.size());
  int neighbour = 0;
  Eigen::Index count = 0;
  for (const auto& [name, value] : effect.numbers) {
    if (name == "neighbour") {
      neighbour = static_cast<int>(std::lround(value)) - 1;
    } else {
      numbers[count++] = value;
    }
  }
  const std::vector<std::string> formats = FormatsWith(effect);
  const std::string share = Literals(
      Eigen::Vector4d(ShareOf(effect, JointTerm::kViscous),
                      ShareOf(effect, JointTerm::kCoulomb), robot.width[j],
                      ShareOf(effect, JointTerm::kOffset)));
  return Law(Upper(effect.found.effect->name), j, Mask(formats),
             numbers.head(count), neighbour, share);
}

// Names of laws as C knows them, and of the formats as bits.
std::string Enumerators() {
  std::string kinds =
      "enum {\n  EFFECTS_CONSTANT,\n"
      "  EFFECTS_YIELDING_FRICTION";
  for (const Effect& effect : Effects()) {
    if (effect.numbers && effect.scope == Effect::Scope::kJoint) {
      kinds += ",\n  EFFECTS_" + Upper(effect.name);
    }
  }
  std::string bits = "enum {\n";
  int bit = 1;
  for (const RobotFormat& format : RobotFormats()) {
    bits += "  EFFECTS_IN_" + Upper(format.name) + " = " + std::to_string(bit) +
            ",\n";
    bit *= 2;
  }
  return kinds + "\n};\n" + bits +
         "  EFFECTS_IN_ALL = " + std::to_string(bit - 1) + "\n};\n";
}

std::string TestTable(const ModuleTest& test) {
  using Step = ModuleTest::Step;
  std::string text =
      "#ifdef EFFECTS_TEST\n"
      "static const double effects_test_dt = " +
      Literal(test.dt) +
      ";\n"
      "static const double effects_test_t = " +
      Literal(test.t) +
      ";\n"
      "static const double effects_test_warmth[] = " +
      Literals(test.warmth) +
      ";\nstatic const double effects_test_load[] = " + Literals(test.load) +
      ";\nstatic const double effects_test_largest[] = {" +
      Literal(test.LargestOf(&Step::reading)) + ", " +
      Literal(test.LargestOf(&Step::torque)) + ", " +
      Literal(test.LargestOf(&Step::damping)) + ", " +
      Literal(test.LargestOf(&Step::undamped)) +
      "};\nstatic const struct effects_test_step {\n"
      "  double q[EFFECTS_JOINTS], qd[EFFECTS_JOINTS];\n"
      "  double commanded[EFFECTS_JOINTS], load[EFFECTS_JOINTS];\n"
      "  int has_load;\n"
      "  double reading[EFFECTS_JOINTS], torque[EFFECTS_JOINTS];\n"
      "  double damping[EFFECTS_JOINTS], undamped[EFFECTS_JOINTS];\n} "
      "effects_test[] = {\n";
  for (const Step& step : test.steps) {
    text += "  {" + Literals(step.q) + ", " + Literals(step.qd) + ",\n   " +
            Literals(step.commanded) + ", " + Literals(step.load) + ", " +
            (step.load.size() > 0 ? "1" : "0") + ",\n   " +
            Literals(step.reading) + ", " + Literals(step.torque) + ",\n   " +
            Literals(step.damping) + ", " + Literals(step.undamped) + "},\n";
  }
  return text + "};\n#endif\n";
}

}  // namespace

std::string CData(const CorrectedRobot& robot, const ModuleTest& test) {
  const int n = robot.plant.robot.num_joints();
  std::string laws, joints;
  for (int j = 0; j < n; ++j) {
    const Joint& joint = robot.plant.robot.links[j].joint;
    joints +=
        "  {" + Quoted(joint.name) + ", " + Literal(joint.armature) + "},\n";
    laws += OwnLaws(robot, j);
  }
  for (const CarriedEffect& effect : robot.effects) {
    laws += EffectLaw(robot, effect);
  }
  return "/* The numbers of effects.c. Written by armcal. */\n\n"
         "#ifndef EFFECTS_DATA_H\n#define EFFECTS_DATA_H\n\n"
         "#define EFFECTS_JOINTS " +
         std::to_string(n) + "\n#define EFFECTS_LAWS " +
         std::to_string(std::count(laws.begin(), laws.end(), '\n')) + "\n\n" +
         Enumerators() +
         "\n#ifdef EFFECTS_TABLES\n"
         "/* By how much torque is recorded later than it acts, s. */\n"
         "static const double effects_delay = " +
         Literal(robot.delay) +
         ";\n/* The robot files that have it. */\n"
         "static const unsigned effects_delay_in = " +
         Mask(FormatsWithDelay(robot)) +
         ";\n/* Those that have constant torques. */\n"
         "static const unsigned effects_offset_in = " +
         Mask(FormatsWithOffset()) +
         ";\nstatic const struct effects_joint {\n  const char* name;\n"
         "  double armature; /* of the motor */\n} effects_joints[] = {\n" +
         joints +
         "};\n/* `in`: the robot files that have it; share: what "
         "the others have in its stead. */\n"
         "static const struct effects_law {\n  int kind, joint, neighbour;\n"
         "  unsigned in;\n"
         "  struct { double viscous, coulomb, width, offset; } share;\n"
         "  double p[7]; /* in the order of effects.json's law */\n"
         "} effects_laws[] = {\n" +
         laws + "};\n" + TestTable(test) + "#endif\n\n#endif\n";
}

}  // namespace armcal
