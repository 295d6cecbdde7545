#include "calib/diagnose/candidates/effect_torques.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "model/signals/delayed_signal.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Numbers effects by their place and values, so that of several sets those laws
// are known that are copies of one (JointLaw::copy_of).
class EffectNumbering {
 public:
  void Apply(const GapCandidate& effect, const EffectSite& site,
             SimulatedRobot* robot) {
    constexpr int kMostLaws = 64;  // of an effect
    const size_t before = robot->joint_laws.size();
    effect.effect->apply(site, effect.p, robot);
    CHECK_LE(robot->joint_laws.size(), before + kMostLaws);
    const int first = kMostLaws * NumberOf(effect);
    for (size_t i = before; i < robot->joint_laws.size(); ++i) {
      robot->joint_laws[i].copy_of = first + static_cast<int>(i - before);
    }
  }

 private:
  int NumberOf(const GapCandidate& effect) {
    const auto known =
        std::find_if(all_.begin(), all_.end(), [&](const GapCandidate* other) {
          return SamePlace(*other, effect) && other->p == effect.p;
        });
    const int number = static_cast<int>(known - all_.begin());
    if (known == all_.end()) all_.push_back(&effect);
    return number;
  }

  std::vector<const GapCandidate*> all_;
};

// Takes the delay of all joints' torque out of a robot, s: 0 where the torque
// was reconstructed from the motion, whose noise it has.
double TakeDelay(const GapSegment& segment, SimulatedRobot* robot) {
  if (segment.reconstructed_torque) return 0;
  return std::exchange(robot->torque_delay, 0);
}

// A delay D of what was recorded, y(t) = m(t - D), adds y(t) - y(t + D) to it.
// This moves the recording itself, so that what it leaves is y(t + D) less the
// model: no part of a delay is lost with what the model has wrong, as there is
// of m(t - D) - m(t). As a column, to be scaled, it would not do: its noise is
// that of the residual.
void AddDelay(const GapSegment& segment, double delay,
              RecordedTorque::OfJoints* joints) {
  if (delay == 0) return;
  const MatrixXd change =
      segment.tau - Delayed(segment.tau, -delay / segment.motion.dt);
  for (Eigen::Index j = 0; j < change.cols(); ++j) {
    VectorXd& joint = (*joints)[j];
    joint = joint.size() > 0 ? VectorXd(joint + change.col(j))
                             : VectorXd(change.col(j));
  }
}

}  // namespace

// What effects with these parameters add to the torque of these logs.
JointRows EffectTorque(const GapBaseline& baseline, const MotionScale& scale,
                       const std::vector<GapCandidate>& effects,
                       GapData* data) {
  return EffectTorques(baseline, scale, {effects}, data->rows(),
                       data->mutable_torques())[0];
}

// The torque of several sets of effects along the same recorded motion,
// evaluated together (RecordedTorque::Changes). What happened once is in its
// own log only.
std::vector<JointRows> EffectTorques(
    const GapBaseline& baseline, const MotionScale& scale,
    const std::vector<std::vector<GapCandidate>>& sets, const GapRows& rows,
    std::vector<RecordedTorque>* torques) {
  std::vector<JointRows> thin(sets.size(), JointRows(rows.num_joints()));
  std::vector<JointRows*> to;
  for (JointRows& one : thin) to.push_back(&one);
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), log = rows.segments()[i].log;
    std::vector<SimulatedRobot> changed(sets.size());
    std::vector<double> delays(sets.size());
    EffectNumbering numbering;
    for (size_t k = 0; k < sets.size(); ++k) {
      changed[k].robot = baseline.robot();
      for (const GapCandidate& effect : sets[k]) {
        if (!effect.IsIn(log)) continue;
        numbering.Apply(effect, {&baseline.robot(), effect.joint, &scale},
                        &changed[k]);
      }
      delays[k] = TakeDelay(rows.segments()[i], &changed[k]);
    }
    std::vector<RecordedTorque::OfJoints> changes =
        (*torques)[i].Changes(changed);
    for (size_t k = 0; k < sets.size(); ++k) {
      AddDelay(rows.segments()[i], delays[k], &changes[k]);
    }
    AddThinned(rows, s, changes, to);
  }
  return thin;
}

JointRows WhitenEach(const GapRows& rows, const JointRows& thin) {
  JointRows white(thin.size());
  for (size_t j = 0; j < thin.size(); ++j) {
    if (thin[j].size() == 0) continue;
    white[j] = rows.Whiten(static_cast<int>(j), thin[j]);
  }
  return white;
}

}  // namespace armcal
