#include "calib/linear/transition_bound.h"

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

}  // namespace

// A width at the end of the grid is a bound and no estimate: over the speeds of
// the log, tanh(qd / width) is then nearly proportional to qd, which is viscous
// friction's column.
std::vector<std::string> TransitionWarnings(const Robot& robot,
                                            const LinearCalibration& result) {
  std::vector<std::string> sentences;
  if (!result.solved || !result.fitted_transitions) return sentences;
  for (int i = 0; i < robot.num_joints(); ++i) {
    const CoulombTransition& t = result.transitions[i];
    if (t.width < LargestTransition(t.law) || !SeesCoulomb(result, i)) continue;
    const Joint& joint = robot.links[i].joint;
    const bool velocity = t.law == CoulombTransition::Law::kVelocity;
    sentences.push_back(
        joint.name +
        Format(
            ": Coulomb friction changes sign over %.3g %s%s, the largest "
            "width that is tried: viscous and Coulomb friction trade; raise ",
            t.width, PositionUnit(joint.type), velocity ? "/s" : "") +
        OptionName("bandwidth") + ", log faster reversals, or give " +
        OptionName("coulomb_width"));
  }
  return sentences;
}

}  // namespace armcal
