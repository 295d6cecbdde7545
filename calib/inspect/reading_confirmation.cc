#include "calib/inspect/reading_confirmation.h"

#include <algorithm>
#include <cmath>

#include "calib/inspect/robot_description.h"
#include "calib/inspect/torque_scale.h"

namespace armcal {
namespace {

using Kind = ReadingChange::Kind;

// Delays that have nothing to do with each other, anywhere within the 80 ms to
// either side, agree within two deviations of each, some 10 ms, in a fourth of
// the cases where there are two, and in a sixteenth where there are three.
constexpr int kFewWhoAgree = 2;
constexpr double kParallel = .999;  // cosine of the axes' angle

// Whether more than half of the squares that are left as it is are gone, in
// both halves and all samples.
bool ExplainsMost(const HeldOutFit& as_is, const HeldOutFit& changed) {
  return (2 * changed.all.array() < as_is.all.array()).all();
}

// Whether two joints turn about axes that are parallel in all postures, as
// joints between them do, too: what of the motion is in the one's angle may be
// in the other's.
bool TurnAlike(const Robot& robot, int a, int b) {
  const std::vector<Eigen::Vector3d> axes = AxesAtZero(robot);
  const int first = std::min(a, b);
  for (int j = std::max(a, b); j >= first; j = robot.parent(j)) {
    if (!IsRotational(robot.links[j].joint.type) ||
        !(std::abs(axes[j].dot(axes[first])) > kParallel)) {
      return false;
    }
    if (j == first) return true;
  }
  return false;  // on another branch
}

bool AreSignsOfParallelJoints(const Robot& robot, const ReadingChange& a,
                              const ReadingChange& b) {
  return a.kind == Kind::kPositionSign && b.kind == Kind::kPositionSign &&
         a.joint != b.joint && TurnAlike(robot, a.joint, b.joint);
}

}  // namespace

bool BringsInReach(const ReadingState& state, const Candidate& candidate) {
  const std::vector<int> joints = JointsOf(candidate.change);
  // Speeds are of the clock as much as of a unit.
  const bool asks_speed = candidate.change.kind != Kind::kDegrees &&
                          candidate.change.kind != Kind::kMillimetres;
  return !joints.empty() && candidate.change.kind != Kind::kTorqueSign &&
         candidate.change.kind != Kind::kTorquesExchanged &&
         !state.AreInReach(state.best, joints, asks_speed) &&
         state.AreInReach(candidate.reading, joints, asks_speed);
}

bool IsConfirmed(const ReadingState& state, const Candidate& candidate,
                 const HeldOutFit& as_is, const HeldOutFit& held_out) {
  const ReadingChange& change = candidate.change;
  const bool all_fit_better = IsBetterForAll(
      OfColumns(as_is, state.best.wiring.torque_column),
      OfColumns(held_out, candidate.reading.wiring.torque_column));
  const bool leaves_less = held_out.residual_percent < as_is.residual_percent;
  if (change.kind == Kind::kDelay) {
    if (state.joints_of_delay == 1) return all_fit_better;
    return leaves_less && (state.joints_of_delay > kFewWhoAgree ||
                           ExplainsMost(as_is, held_out));
  }
  // One of the two is right, and the fit, whose friction and armature take
  // power and whose inertias are near the file's, tells which: of 98 logs of
  // ../shared/data with all torques negated it is likelier so in 97, by 107
  // to 5000 nats, and in the 98th, where it is not, this confirms neither.
  if (IsAllSigns(change.kind) && all_fit_better) return true;
  // Free inertias take half of a wrong sign's misfit in slow motion; the
  // file's own, which are opposite to all torques then, do not.
  if (change.kind == Kind::kAllTorqueSigns &&
      state.ScalesOf(state.best).AreOpposite() && leaves_less) {
    return true;
  }
  // As of a unit: where limits tell, torques only have to fit better.
  if (leaves_less && BringsInReach(state, candidate)) return true;
  // Columns of single joints stand in the motion of all: what is wrong with
  // them shows in the torques of others, too. That of a joint which hardly
  // works may fit better by chance, and a direction of gravity or a unit is
  // so free that it fits what is not its own.
  if (!JointsOf(change).empty() && all_fit_better &&
      IsBetterInTotal(as_is, held_out)) {
    return true;
  }
  return IsClearlyBetter(as_is, held_out, JointsOf(change)) ||
         (IsOneSign(change.kind) &&
          (IsFirstToExplain(as_is, held_out, change.joint) ||
           IsBetterSign(as_is, held_out, change.joint)));
}

std::vector<ReadingChange> AlternativesTo(size_t k, const HeldOutFit& held_out,
                                          const std::vector<double>& misfits,
                                          const std::vector<Candidate>& all,
                                          const ReadingState& state) {
  const ReadingChange& change = all[k].change;
  std::vector<ReadingChange> alternatives;
  for (size_t i = 0; i < all.size(); ++i) {
    const ReadingChange& other = all[i].change;
    if ((!MayBeEither(other, change) &&
         !AreSignsOfParallelJoints(state.robot, other, change)) ||
        all[i].reading.gravity != all[k].reading.gravity) {
      continue;
    }
    bool does_as_well = misfits[i] < misfits[k] + kLeastReadingGain;
    if (!does_as_well && misfits[i] < state.misfit - kLeastReadingGain) {
      const HeldOutFit fit = state.HeldOut(all[i].reading);
      does_as_well = IsConfirmed(state, all[i], state.held_out, fit) &&
                     !IsClearlyBetter(fit, held_out, JointsOf(change));
    }
    if (does_as_well) alternatives.push_back(other);
  }
  return alternatives;
}

}  // namespace armcal
