#include "calib/poses/correction/correction_code.h"

#include <algorithm>

#include "calib/poses/correction/correction_body.h"
#include "calib/poses/correction/joint_correction.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Isometry3d;

constexpr char kWhat[] = R"(
   int armcal_command_correction(const double q[JOINTS], double dq[JOINTS]):
     what to add to joint positions that a controller computed with the robot
     file's kinematics, so that the tool gets where these say.
   int armcal_forward_correction(const double q[JOINTS], double dq[JOINTS]):
     what to add to recorded joint positions, so that the robot file's kinematics
     give where the tool is.
   void armcal_actual_pose(const double q[JOINTS], double pose[12]):
     the tool's pose in the base frame at recorded joint positions: rows of the
     3 x 4 matrix (R p), m.
   void armcal_file_pose(const double q[JOINTS], double pose[12]):
     the same by the robot file.
   Corrections return 1 where they meet the other pose (to a micrometre and 10
   microradians), and 0 where no posture nearby does: out of reach, singular, or
   of less than six joints. dq is then the nearest that was found, which may be 0.
   Joint positions in rad or m. Nothing is kept between calls.
)";

std::string Numbers(const Isometry3d& X) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      text += Format("%s%.17g", text.empty() ? "" : ", ", X.matrix()(i, j));
    }
  }
  return "{" + text + "}";
}

std::string Links(const char* name, const Robot& robot) {
  std::string text = Format("static const struct link %s[JOINTS] = {\n", name);
  for (const Link& link : robot.links) {
    text += Format("    {%s,\n     %s,\n     %d},\n",
                   Numbers(link.X_PF).c_str(), Numbers(link.X_ML).c_str(),
                   IsRotational(link.joint.type) ? 0 : 1);
  }
  return text + "};\n";
}

// What each link weighs, N, and the moment of that about its frame's origin, by
// the lever in its frame, N m: of an arm that was weighed.
std::string Weights(const ActualArm& arm) {
  std::string text = "static const double weights[JOINTS][4] = {";
  const double g = arm.known().weighed ? arm.file().gravity.norm() : 0;
  for (const Link& link : arm.file().links) {
    const Eigen::Vector3d h = g * link.inertial.first_moment;
    text += Format("\n    {%.17g, %.17g, %.17g, %.17g},",
                   g * link.inertial.mass, h.x(), h.y(), h.z());
  }
  return text + "};\n";
}

const char* KindOf(PostureSignal::Of of) {
  using Of = PostureSignal::Of;
  switch (of) {
    case Of::kPosition:
      return "POSITION";
    case Of::kSine:
      return "SINE";
    case Of::kCosine:
      return "COSINE";
    case Of::kToolMoment:
      return "TOOL_MOMENT";
    case Of::kLinkMoment:
      return "LINK_MOMENT";
    case Of::kWeightMoment:
      return "WEIGHT_MOMENT";
    case Of::kLoadSide:
      return "LOAD_SIDE";
    case Of::kBaseMoment:
      return "BASE_MOMENT";
    case Of::kToolGravity:
      return "TOOL_GRAVITY";
    case Of::kOne:
    case Of::kNothing:
      break;
  }
  return "ONE";
}

std::string Terms(const ActualArm& arm) {
  std::string text =
      "enum {JOINT, BASE, TOOL};\n"
      "enum {ONE, POSITION, SINE, COSINE, TOOL_MOMENT, LINK_MOMENT,\n"
      "      WEIGHT_MOMENT, LOAD_SIDE,\n"
      "      BASE_MOMENT, TOOL_GRAVITY};\n"
      "struct term {\n"
      "  int moves, index, kind, of;\n"
      "  double harmonic, amount;\n"
      "};\n";
  text += Format("enum {TERMS = %d};\n", static_cast<int>(arm.terms().size()));
  text += "static const struct term terms[TERMS + 1] = {\n";
  for (const ActualArm::Term& term : arm.terms()) {
    const char* moves = term.acts == PoseTerm::Acts::kJoint  ? "JOINT"
                        : term.acts == PoseTerm::Acts::kBase ? "BASE"
                                                             : "TOOL";
    text += Format("    {%s, %d, %s, %d, %.17g, %.17g},\n", moves, term.index,
                   KindOf(term.signal.of), term.signal.index,
                   term.signal.harmonic, term.amount);
  }
  return text + "    {0, 0, 0, 0, 0, 0}};\n";
}

}  // namespace

std::string CorrectionCode(const ActualArm& arm,
                           const CorrectionErrors& errors) {
  const Eigen::Vector3d down = arm.file().gravity.stableNormalized();
  std::string name = arm.file().name;
  std::replace(name.begin(), name.end(), '*', '_');  // ends no comment
  std::string text = "/* Joint corrections of " + name +
                     ", by armcal from measured poses.\n" + kWhat;
  text += Format(
      "   Where the poses' model is right, corrected commands bring the tool\n"
      "   to where the robot file has it within %.2g mm (median of 1000\n"
      "   postures; 95 %%: %.2g, largest: %.2g), instead of %.3g (%.3g, "
      "%.3g):\n"
      "   near singular postures joints do not make up for all. */\n\n",
      1e3 * std::max(1e-6, errors.command.median),
      1e3 * std::max(1e-6, errors.command.p95),
      1e3 * std::max(1e-6, errors.command.most), 1e3 * errors.before.median,
      1e3 * errors.before.p95, 1e3 * errors.before.most);
  text += "#include <math.h>\n\n";
  text += Format(
      "enum {JOINTS = %d, STEPS = %d};\n"
      "static const double LEVER = %g, DAMPING = %g, DIFFERENCE = %g;\n"
      "static const double SETTLED = %g, MET = 1e-6;\n",
      arm.num_joints(), kCorrectionSteps, kCorrectionLever, kCorrectionDamping,
      kCorrectionDifference, kCorrectionSettled);
  text +=
      "/* From the frame of the link before to the joint's, whose z axis it "
      "turns\n"
      "   about or slides along, and from there to its own link's. */\n"
      "struct link {\n"
      "  double before[12], after[12];\n"
      "  int slides;\n"
      "};\n";
  text += Links("by_file", arm.file()) + Links("refined", arm.links());
  text += "static const double tool[12] = " + Numbers(arm.file().X_LT) + ";\n";
  text += "static const double zeros[JOINTS] = {";
  for (int i = 0; i < arm.num_joints(); ++i) {
    text += Format("%s%.17g", i > 0 ? ", " : "", arm.zeros()[i]);
  }
  text += "};\n";
  text += Format("static const double down[3] = {%.17g, %.17g, %.17g};\n",
                 down.x(), down.y(), down.z());
  return text + Weights(arm) + Terms(arm) + kCorrectionBody;
}

}  // namespace armcal
