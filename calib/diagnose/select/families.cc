#include "calib/diagnose/select/families.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/selection.h"
#include "model/dynamics/joint_term.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// EffectParameter::size, as a share of what the joint does.
constexpr double kSizeThatMatters = .05;

// Whether a calibration looked for the term, which the robot has then, if only
// as none.
bool IsCalibrated(JointTerm term, const BaselineOptions& options) {
  if (options.posterior == nullptr) return false;
  const auto& known = options.posterior->parameters;
  return std::any_of(known.begin(), known.end(), [&](const auto& parameter) {
    return parameter.term == term;
  });
}

// Effects that are a joint term which the robot gives no joint. Not those of a
// recording: a torque's zero is in no robot file, and is known within a prior.
std::vector<const Effect*> LackedTerms(const Robot& robot,
                                       const BaselineOptions& options) {
  std::vector<const Effect*> terms;
  for (const Effect& effect : Effects()) {
    if (!effect.joint_term || effect.nature == Effect::Nature::kRecording) {
      continue;
    }
    if (IsCalibrated(*effect.joint_term, options)) continue;
    const bool lacked = std::all_of(
        robot.links.begin(), robot.links.end(), [&](const Link& link) {
          return TermOf(*effect.joint_term, link.joint) == 0;
        });
    if (lacked) terms.push_back(&effect);
  }
  return terms;
}

// A candidate per joint and lacked term, family after family.
std::vector<GapCandidate> Candidates(const Robot& robot,
                                     const std::vector<const Effect*>& terms,
                                     const MotionScale& scale) {
  std::vector<GapCandidate> candidates;
  for (const Effect* effect : terms) {
    CHECK_EQ(effect->parameters.size(), 1u) << effect->name;
    for (int j = 0; j < robot.num_joints(); ++j) {
      GapCandidate candidate;
      candidate.effect = effect;
      candidate.joint = j;
      candidate.p = VectorXd::Zero(1);
      candidate.linear = {0};
      candidate.size = VectorXd::Constant(
          1, std::max(1e-9, effect->parameters[0].size({&robot, j, &scale})));
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

class FamilyFit {
 public:
  FamilyFit(const Robot& robot, const BaselineOptions& options,
            double bandwidth_hz, const std::vector<GapSegment>& segments,
            const std::vector<const Effect*>& terms)
      : robot_(robot),
        terms_(terms),
        baseline_(robot, options, UsualTorque(segments)),
        data_(segments, baseline_, bandwidth_hz) {
    scale_ = ScaleOf(baseline_, data_.rows(), data_.torques());
    candidates_ = Candidates(robot, terms, scale_);
    EvaluateCandidates(baseline_, data_.rows(), scale_, data_.torques(),
                       &candidates_);
    noise_ = WhiteNoise(data_.residual());
    // Joints count by what all families leave of them.
    for (int round = 0; round < 3; ++round) {
      Weigh();
      const VectorXd left = Left(static_cast<int>(terms_.size()));
      for (int j = 0; j < left.size(); ++j) {
        noise_[j].sigma = std::max(1e-9, left[j]);
      }
    }
    Weigh();
    DropNegative();
  }

  LackedFamilies Result() const {
    LackedFamilies result;
    result.robot = robot_;
    result.without = Left(0);
    for (int f = 0; f < static_cast<int>(terms_.size()); ++f) {
      const LackedFamily family = Family(f);
      const bool lacked = family.drop > LeastDrop(family);
      for (int j = 0; j < robot_.num_joints(); ++j) {
        const double least = 1e-6 * candidates_[CandidateOf(f, j)].size[0];
        *TermOf(family.term, &result.robot.links[j].joint) =
            lacked && family.value[j] != 0 ? family.value[j] : least;
      }
      if (lacked) result.families.push_back(family);
    }
    return result;
  }

 private:
  void Weigh() {
    data_.SetNoise(noise_);
    screen_.emplace(data_.Screen());
    AddCandidates(data_.rows(), &candidates_, &*screen_);
    screen_->Factor();
  }
  int CandidateOf(int family, int joint) const {
    return family * robot_.num_joints() + joint;
  }
  int FamilyOf(int candidate) const { return candidate / robot_.num_joints(); }
  JointTerm TermOfCandidate(int candidate) const {
    return *terms_[FamilyOf(candidate)]->joint_term;
  }

  // Joints whose friction or armature would be negative have none: what asks
  // for it is something else.
  void DropNegative() {
    while (true) {
      const std::vector<int> all = Members(static_cast<int>(terms_.size()));
      const GapScreen::Fit fit = screen_->Solve(ColumnsOf(candidates_, all));
      int most = -1;
      double depth = 0;
      for (size_t k = 0; k < all.size(); ++k) {
        if (TermOfCandidate(all[k]) == JointTerm::kOffset) continue;
        const double deviations =
            fit.coefficients[k] / std::sqrt(fit.covariance(k, k));
        if (deviations < depth) depth = deviations, most = all[k];
      }
      if (most < 0) return;
      none_.insert(most);
    }
  }

  // As an effect has to: a file without friction may be right.
  double LeastDrop(const LackedFamily& family) const {
    return SelectionOptions().threshold +
           (family.value.array() != 0).count() *
               std::log(static_cast<double>(data_.rows().num_rows()));
  }

  LackedFamily Family(int f) const {
    const int n = robot_.num_joints(), count = static_cast<int>(terms_.size());
    LackedFamily family;
    family.effect = terms_[f];
    family.term = *terms_[f]->joint_term;
    family.value = family.stddev = family.usual = VectorXd::Zero(n);
    for (int j = 0; j < n; ++j) {
      family.usual[j] =
          candidates_[CandidateOf(f, j)].size[0] / kSizeThatMatters;
    }
    const GapScreen::Fit all = Solve(count);
    std::vector<int> others;
    const std::vector<int> members = Members(count);
    for (size_t k = 0; k < members.size(); ++k) {
      if (FamilyOf(members[k]) != f) {
        others.push_back(members[k]);
        continue;
      }
      const int j = members[k] - CandidateOf(f, 0);
      const double size = candidates_[members[k]].size[0];
      family.value[j] = all.coefficients[k] * size;
      family.stddev[j] = std::sqrt(all.covariance(k, k)) * size;
    }
    family.drop =
        all.drop - screen_->Solve(ColumnsOf(candidates_, others)).drop;
    family.left = Left(f + 1);
    return family;
  }

  // Candidates of the first `families` that are not known to be zero.
  std::vector<int> Members(int families) const {
    std::vector<int> members;
    for (int c = 0; c < CandidateOf(families, 0); ++c) {
      if (none_.count(c) == 0) members.push_back(c);
    }
    return members;
  }
  GapScreen::Fit Solve(int families) const {
    return screen_->Solve(ColumnsOf(candidates_, Members(families)));
  }
  VectorXd Left(int families) const {
    const GapScreen::Fit fit = Solve(families);
    VectorXd left(robot_.num_joints());
    for (int j = 0; j < left.size(); ++j) {
      const VectorXd residual = screen_->Residual(j, fit);
      left[j] = noise_[j].sigma *
                std::sqrt(residual.squaredNorm() /
                          std::max<Eigen::Index>(1, residual.size()));
    }
    return left;
  }

  const Robot& robot_;
  std::vector<const Effect*> terms_;
  GapBaseline baseline_;
  GapData data_;
  MotionScale scale_;
  std::vector<GapCandidate> candidates_;
  std::set<int> none_;  // of them, that are zero
  std::vector<Autoregression> noise_;
  std::optional<GapScreen> screen_;
};

}  // namespace

LackedFamilies FitLackedFamilies(const Robot& robot,
                                 const BaselineOptions& options,
                                 double bandwidth_hz,
                                 const std::vector<GapSegment>& segments) {
  const std::vector<const Effect*> lacked = LackedTerms(robot, options);
  LackedFamilies none;
  none.robot = robot;
  if (lacked.empty()) return none;
  return FamilyFit(robot, options, bandwidth_hz, segments, lacked).Result();
}

}  // namespace armcal
