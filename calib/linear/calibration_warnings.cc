#include "calib/linear/calibration_warnings.h"

#include "calib/linear/transition_choice.h"
#include "model/text/format.h"
#include "model/text/option_name.h"

namespace armcal {
namespace {

// Whether the joint's Coulomb friction is in the model and seen.
bool SeesCoulomb(const LinearCalibration& result, int joint) {
  for (int k = 0; k < result.parameters.size(); ++k) {
    const ModelParameter& p = result.parameters.parameters()[k];
    if (p.is_joint_term && p.term == JointTerm::kCoulomb && p.block == joint) {
      return result.identifiable[k];
    }
  }
  return false;
}

// A width at the end of the grid is a bound and no estimate: over the speeds of
// the log, tanh(qd / width) is then nearly proportional to qd, which is viscous
// friction's column.
void WarnOfTransitions(const Robot& robot, const LinearCalibration& result,
                       std::vector<std::string>* sentences) {
  if (!result.solved || !result.fitted_transitions) return;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const CoulombTransition& t = result.transitions[i];
    if (t.width < LargestTransition(t.law) || !SeesCoulomb(result, i)) continue;
    const Joint& joint = robot.links[i].joint;
    const bool velocity = t.law == CoulombTransition::Law::kVelocity;
    sentences->push_back(
        joint.name +
        Format(
            ": Coulomb friction changes sign over %.3g %s%s, the largest "
            "width that is tried: viscous and Coulomb friction trade; raise ",
            t.width, PositionUnit(joint.type), velocity ? "/s" : "") +
        OptionName("bandwidth") + ", log faster reversals, or give " +
        OptionName("coulomb_width"));
  }
}

// By chance a residual's rms differs from log to log by some hundredths where
// they have hundreds of independent samples. Twice as much is another friction,
// an effect that the model lacks, or parameters that the fitted motion told too
// little of: none of which the standard deviations hold.
constexpr double kCarriesOver = 2;

void WarnOfHeldOut(const Robot& robot, const LinearCalibration& result,
                   std::vector<std::string>* sentences) {
  if (!result.solved || !result.training || !result.validation) return;
  const TorqueResidual::Figures fit = result.training->moving();
  const TorqueResidual::Figures held_out = result.validation->moving();
  std::string joints;
  for (int i = 0; i < robot.num_joints(); ++i) {
    if (held_out.residual_rms[i] > kCarriesOver * fit.residual_rms[i] &&
        held_out.percent[i] > kCarriesOver * fit.percent[i]) {
      joints += (joints.empty() ? "" : ", ") + robot.links[i].joint.name +
                Format(" (%.3g %%, fitted %.3g %%)", held_out.percent[i],
                       fit.percent[i]);
    }
  }
  if (joints.empty()) return;
  sentences->push_back(
      "held out, more than twice as much of the torque is left as where it was "
      "fitted: " +
      joints +
      ". The robot was another then (warmer, loaded), the model lacks what "
      "that motion shows, or the fitted motion told too little; a diagnosis "
      "may say which");
}

void WarnOfSpikes(const Robot& robot, const LinearCalibration& result,
                  std::vector<std::string>* sentences) {
  for (int i = 0; i < result.position_spikes.size(); ++i) {
    const long rows = result.position_spikes[i];
    if (rows == 0) continue;
    sentences->push_back(
        robot.links[i].joint.name +
        Format(": %ld wrong sample%s of its position %s left out, at which it "
               "leaves its motion and comes back; armcal inspect says when",
               rows, rows == 1 ? "" : "s", rows == 1 ? "was" : "were"));
  }
}

}  // namespace

std::vector<std::string> CalibrationWarnings(const Robot& robot,
                                             const LinearCalibration& result) {
  std::vector<std::string> sentences;
  WarnOfSpikes(robot, result, &sentences);
  WarnOfTransitions(robot, result, &sentences);
  WarnOfHeldOut(robot, result, &sentences);
  return sentences;
}

}  // namespace armcal
