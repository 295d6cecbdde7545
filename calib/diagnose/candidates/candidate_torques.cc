#include "calib/diagnose/candidates/candidate_torques.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Torques of one segment, low-passed and thinned, into the thinned samples of
// all of them, whichever joint and torque they are of.
void AddThinned(const GapRows& rows, int segment,
                const std::vector<RecordedTorque::OfJoints>& torques,
                const std::vector<JointRows*>& thin) {
  std::vector<const VectorXd*> fine;
  std::vector<VectorXd*> to;
  for (size_t i = 0; i < torques.size(); ++i) {
    for (int j = 0; j < rows.num_joints(); ++j) {
      if (torques[i][j].size() == 0) continue;
      VectorXd& all = (*thin[i])[j];
      if (all.size() == 0) all = VectorXd::Zero(rows.num_thin());
      fine.push_back(&torques[i][j]);
      to.push_back(&all);
    }
  }
  const MatrixXd low = rows.Thin(segment, fine);
  for (size_t c = 0; c < to.size(); ++c) {
    to[c]->segment(rows.thin_begin(segment), low.rows()) = low.col(c);
  }
}

namespace {

// One linear parameter of a candidate: the robot with the effect at its size in
// this parameter alone, all others 0, since its column is a derivative.
struct TorqueOf {
  GapCandidate* candidate;
  size_t k;

  SimulatedRobot Robot(const GapBaseline& baseline,
                       const MotionScale& scale) const {
    VectorXd p = candidate->p;
    p[candidate->linear[k]] = candidate->size[k];
    SimulatedRobot changed;
    changed.robot = baseline.robot();
    candidate->effect->apply({&baseline.robot(), candidate->joint, &scale}, p,
                             &changed);
    return changed;
  }
};

// Of a parameter that these joints do not show (a moment along the only axis
// that turns its link) rounding is left, which a fit would divide by: there is
// none.
void ForgetRounding(const MotionScale& scale, JointRows* torque) {
  constexpr double kRounding = 1e-9;  // of the joint's torque
  for (size_t j = 0; j < torque->size(); ++j) {
    VectorXd& own = (*torque)[j];
    if (own.size() == 0) continue;
    const double usual = scale.torque[static_cast<Eigen::Index>(j)];
    if (own.cwiseAbs().maxCoeff() <= kRounding * usual) own.resize(0);
  }
}

// Torques of several candidates at once, segment by segment.
// RecordedTorque::Changes simulates what differs from the same recorded motion
// for all of them in one pass; positions and their kinematics are common.
void Evaluate(const std::vector<TorqueOf>& torques, const GapBaseline& baseline,
              const GapRows& rows, const MotionScale& scale,
              std::vector<RecordedTorque>* recorded) {
  for (const TorqueOf& one : torques) {
    one.candidate->torque[one.k].resize(rows.num_joints());
  }
  for (size_t s = 0; s < recorded->size(); ++s) {
    std::vector<SimulatedRobot> changed;
    std::vector<JointRows*> thin;
    for (const TorqueOf& one : torques) {
      if (!one.candidate->IsIn(rows.segments()[s].log)) continue;
      changed.push_back(one.Robot(baseline, scale));
      thin.push_back(&one.candidate->torque[one.k]);
    }
    AddThinned(rows, static_cast<int>(s), (*recorded)[s].Changes(changed),
               thin);
  }
  for (const TorqueOf& one : torques) {
    ForgetRounding(scale, &one.candidate->torque[one.k]);
  }
}

// Whether its torque depends on the terms of its own joint at most. What a
// drive or a sensor makes of torques is a function of all of a torque, and may
// be one of another joint's.
bool IsOfOwnJoint(const GapCandidate& candidate, const Robot& robot,
                  const MotionScale& scale) {
  if (candidate.joint < 0) return false;
  SimulatedRobot with;
  with.robot = robot;
  candidate.effect->apply({&robot, candidate.joint, &scale}, candidate.p,
                          &with);
  return with.actuators.empty();
}

std::vector<bool> HaveSameTerms(const Robot& first, const Robot& second) {
  std::vector<bool> same(first.num_joints(), true);
  for (int j = 0; j < first.num_joints(); ++j) {
    for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb,
                                 JointTerm::kOffset, JointTerm::kArmature}) {
      same[j] = same[j] && TermOf(term, first.links[j].joint) ==
                               TermOf(term, second.links[j].joint);
    }
  }
  return same;
}

}  // namespace

std::vector<GapCandidate> WithSameTorques(const Robot& first,
                                          const Robot& second,
                                          const MotionScale& scale,
                                          std::vector<GapCandidate> evaluated) {
  const std::vector<bool> same = HaveSameTerms(first, second);
  if (std::count(same.begin(), same.end(), false) == 0) return evaluated;
  evaluated.erase(std::remove_if(evaluated.begin(), evaluated.end(),
                                 [&](const GapCandidate& one) {
                                   return !IsOfOwnJoint(one, first, scale) ||
                                          !same[one.joint];
                                 }),
                  evaluated.end());
  return evaluated;
}

void ReuseTorques(std::vector<GapCandidate>* evaluated,
                  std::vector<GapCandidate>* candidates) {
  for (GapCandidate& candidate : *candidates) {
    const auto same = std::find_if(
        evaluated->begin(), evaluated->end(), [&](const GapCandidate& other) {
          return !other.torque.empty() && SamePlace(other, candidate) &&
                 other.log == candidate.log && other.p == candidate.p &&
                 other.size == candidate.size;
        });
    if (same != evaluated->end()) candidate.torque = std::move(same->torque);
  }
}

// Fills in the torques of those candidates that have none, kTogether of them to
// a task and tasks in parallel. Each thread has its own copy of the recorded
// torques, which hold what they have evaluated.
void EvaluateCandidates(const GapBaseline& baseline, const GapRows& rows,
                        const MotionScale& scale,
                        const std::vector<RecordedTorque>& torques,
                        std::vector<GapCandidate>* candidates) {
  // Neighbours share what they can, instants of the motion above all.
  constexpr size_t kTogether = 16;
  std::vector<std::vector<TorqueOf>> missing;
  for (GapCandidate& candidate : *candidates) {
    if (!candidate.torque.empty()) continue;
    candidate.torque.resize(candidate.linear.size());
    for (size_t k = 0; k < candidate.linear.size(); ++k) {
      if (missing.empty() || missing.back().size() == kTogether) {
        missing.emplace_back();
      }
      missing.back().push_back({&candidate, k});
    }
  }
  tbb::enumerable_thread_specific<std::vector<RecordedTorque>> own(
      [&torques] { return torques; });
  tbb::parallel_for(
      tbb::blocked_range<size_t>(0, missing.size()),
      [&](const tbb::blocked_range<size_t>& range) {
        for (size_t i = range.begin(); i < range.end(); ++i) {
          Evaluate(missing[i], baseline, rows, scale, &own.local());
        }
      },
      tbb::simple_partitioner());
}

}  // namespace armcal
