#include "calib/diagnose/select/missing_terms.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "calib/diagnose/candidates/candidates.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/screen.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/selection.h"
#include "model/dynamics/joint_term.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// EffectParameter::size, as a share of what the joint does.
constexpr double kSizeThatMatters = .05;

// Whether a calibration looked for the term. Then the robot has it, if only as
// none, and its posterior says how far it may be from that.
bool IsCalibrated(JointTerm term, const BaselineOptions& options) {
  if (options.posterior == nullptr) return false;
  const auto& known = options.posterior->parameters;
  return std::any_of(known.begin(), known.end(), [&](const auto& parameter) {
    return parameter.term == term;
  });
}

// The effects of the catalogue that are a joint term (viscous friction, Coulomb
// friction, armature, ..) which the robot file gives no joint at all, or
// (`given`) those that it gives one. A file that gives it to one joint is taken
// at its word for the others. Terms of a recording are left to their prior: a
// torque's zero is in no robot file.
std::vector<const Effect*> TermsOf(const Robot& robot,
                                   const BaselineOptions& options, bool given) {
  std::vector<const Effect*> terms;
  for (const Effect& effect : Effects()) {
    if (!effect.joint_term || effect.nature == Effect::Nature::kRecording) {
      continue;
    }
    if (IsCalibrated(*effect.joint_term, options)) continue;
    const bool is_missing = std::all_of(
        robot.links.begin(), robot.links.end(), [&](const Link& link) {
          return TermOf(*effect.joint_term, link.joint) == 0;
        });
    if (is_missing != given) terms.push_back(&effect);
  }
  return terms;
}

// A candidate per joint and missing term, term after term.
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

class MissingTermFit {
 public:
  // Whether a joint's value may be negative: a change of the file's may be, and
  // what the file gives none of not.
  enum class Sign { kPositive, kFree };

  // All missing terms are fitted at once as columns of a screen, a column per
  // joint and term. Their noise is what they leave themselves: weights 1 /
  // sigma_j^2 with sigma_j the rms of joint j's residual, found by iterating
  // fit and weights (iteratively reweighted least squares, Carroll and Ruppert
  // 1988), since the first residual holds all of the friction that is missing.
  MissingTermFit(const Robot& robot, const BaselineOptions& options,
                 double bandwidth_hz, const std::vector<GapSegment>& segments,
                 const std::vector<const Effect*>& terms,
                 Sign sign = Sign::kPositive)
      : robot_(robot),
        terms_(terms),
        baseline_(robot, options, UsualTorque(segments)),
        data_(segments, baseline_, bandwidth_hz) {
    scale_ = ScaleOf(baseline_, data_.rows(), data_.torques());
    candidates_ = Candidates(robot, terms, scale_);
    EvaluateCandidates(baseline_, data_.rows(), scale_, data_.torques(),
                       &candidates_);
    noise_ = WhiteNoise(data_.residual());
    // Joints count by what all terms leave of them.
    for (int round = 0; round < 3; ++round) {
      Weigh();
      const VectorXd left = Left(static_cast<int>(terms_.size()));
      for (int j = 0; j < left.size(); ++j) {
        noise_[j].sigma = std::max(1e-9, left[j]);
      }
    }
    Weigh();
    if (sign == Sign::kFree) return;
    RemoveNegative();
    RemoveUnasked();
  }

  // Terms that the logs ask for, and the file's robot with them. A joint whose
  // value is not told gets 1e-6 of a size that would show instead of 0: columns
  // in proportion to a term (how Coulomb friction changes sign) need one to act
  // on.
  MissingTerms Result() const {
    MissingTerms result;
    result.robot = robot_;
    result.without = Left(0);
    for (int f = 0; f < static_cast<int>(terms_.size()); ++f) {
      const MissingTerm term = Term(f);
      const bool is_missing = IsAskedFor(term);
      for (int j = 0; j < robot_.num_joints(); ++j) {
        const double least = 1e-6 * candidates_[CandidateOf(f, j)].size[0];
        *TermOf(term.joint_term, &result.robot.links[j].joint) =
            is_missing && term.value[j] != 0 ? term.value[j] : least;
      }
      if (is_missing) result.terms.push_back(term);
    }
    return result;
  }

  // Terms that the logs ask for where the file gives others: those of which
  // several joints leave less than half with all of them.
  std::vector<JointTerm> Contradicted() const {
    const int all = static_cast<int>(terms_.size());
    const Eigen::ArrayXd with = Left(all).array().square();
    const Eigen::ArrayXd without = Left(0).array().square();
    const auto joints = (with < (1 - Limits().explains) * without).count();
    if (static_cast<double>(joints) < SeveralOf(robot_.num_joints())) return {};
    std::vector<JointTerm> contradicted;
    for (int f = 0; f < all; ++f) {
      const MissingTerm term = Term(f);
      if (IsAskedFor(term)) contradicted.push_back(term.joint_term);
    }
    return contradicted;
  }

 private:
  void Weigh() {
    data_.SetNoise(noise_);
    screen_.emplace(data_.Screen());
    AddCandidates(data_.rows(), &candidates_, &*screen_);
    screen_->Factor();
  }
  int CandidateOf(int f, int joint) const {
    return f * robot_.num_joints() + joint;
  }
  int TermIndexOf(int candidate) const {
    return candidate / robot_.num_joints();
  }
  JointTerm TermOfCandidate(int candidate) const {
    return *terms_[TermIndexOf(candidate)]->joint_term;
  }

  // Joints whose friction or armature would be negative have none: what asks
  // for it is something else.
  void RemoveNegative() {
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

  // Backward elimination: the term that is asked for the least goes first, and
  // the others are fitted and asked again without it. Of two that a motion
  // hardly tells apart (viscous and Coulomb friction of a joint at one speed)
  // neither is asked for given the other, though one of them is.
  void RemoveUnasked() {
    while (true) {
      int least = -1;
      double lacks = 0;
      for (int f = 0; f < static_cast<int>(terms_.size()); ++f) {
        if (unasked_.count(f) > 0) continue;
        const MissingTerm term = Term(f);
        const double by = LeastDeltaChi2(term) - term.delta_chi2;
        if (by >= lacks) lacks = by, least = f;
      }
      if (least < 0) return;
      unasked_.insert(least);
      // What was negative beside it need not be without it.
      none_.clear();
      for (const int f : unasked_) {
        for (int j = 0; j < robot_.num_joints(); ++j) {
          none_.insert(CandidateOf(f, j));
        }
      }
      RemoveNegative();
    }
  }
  bool IsAskedFor(const MissingTerm& term) const {
    return term.delta_chi2 > LeastDeltaChi2(term);
  }

  // As of an effect, at least the threshold and ln N for each joint's parameter
  // is asked (Penalty): a file without friction may be right.
  double LeastDeltaChi2(const MissingTerm& term) const {
    return SelectionOptions().threshold +
           (term.value.array() != 0).count() *
               std::log(static_cast<double>(data_.rows().num_rows()));
  }

  // The f-th term with its values, standard deviations and delta_chi2 given all
  // other missing terms. `usual` inverts how the catalogue defines a size that
  // matters, as kSizeThatMatters of the joint's torque: it is the value with
  // which the term alone would make all of it, the widest prior that is still
  // sensible.
  MissingTerm Term(int f) const {
    const int n = robot_.num_joints(), count = static_cast<int>(terms_.size());
    MissingTerm term;
    term.effect = terms_[f];
    term.joint_term = *terms_[f]->joint_term;
    term.value = term.stddev = term.usual = VectorXd::Zero(n);
    for (int j = 0; j < n; ++j) {
      term.usual[j] = candidates_[CandidateOf(f, j)].size[0] / kSizeThatMatters;
    }
    const GapScreen::Fit all = Solve(count);
    std::vector<int> others;
    const std::vector<int> members = Members(count);
    for (size_t k = 0; k < members.size(); ++k) {
      if (TermIndexOf(members[k]) != f) {
        others.push_back(members[k]);
        continue;
      }
      const int j = members[k] - CandidateOf(f, 0);
      const double size = candidates_[members[k]].size[0];
      term.value[j] = all.coefficients[k] * size;
      term.stddev[j] = std::sqrt(all.covariance(k, k)) * size;
    }
    term.delta_chi2 = all.delta_chi2 -
                      screen_->Solve(ColumnsOf(candidates_, others)).delta_chi2;
    term.left = Left(f + 1);
    return term;
  }

  // Candidates of the first `terms` that are not known to be zero.
  std::vector<int> Members(int terms) const {
    std::vector<int> members;
    for (int c = 0; c < CandidateOf(terms, 0); ++c) {
      if (none_.count(c) == 0) members.push_back(c);
    }
    return members;
  }
  GapScreen::Fit Solve(int terms) const {
    return screen_->Solve(ColumnsOf(candidates_, Members(terms)));
  }
  VectorXd Left(int terms) const {
    const JointRows residuals = screen_->Residuals(Solve(terms));
    VectorXd left(robot_.num_joints());
    for (int j = 0; j < left.size(); ++j) {
      const VectorXd& residual = residuals[j];
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
  std::set<int> unasked_;  // terms
  std::set<int> none_;     // candidates that are zero
  std::vector<Autoregression> noise_;
  std::optional<GapScreen> screen_;
};

}  // namespace

MissingTerms FitMissingTerms(const Robot& robot, const BaselineOptions& options,
                             double bandwidth_hz,
                             const std::vector<GapSegment>& segments) {
  const std::vector<const Effect*> missing = TermsOf(robot, options, false);
  MissingTerms none;
  none.robot = robot;
  if (missing.empty()) return none;
  return MissingTermFit(robot, options, bandwidth_hz, segments, missing)
      .Result();
}

std::vector<JointTerm> FindPlaceholders(
    const Robot& robot, const BaselineOptions& options, double bandwidth_hz,
    const std::vector<GapSegment>& segments) {
  if (options.posterior != nullptr || robot.num_joints() < 2) return {};
  const std::vector<const Effect*> given = TermsOf(robot, options, true);
  if (given.empty()) return {};
  return MissingTermFit(robot, options, bandwidth_hz, segments, given,
                        MissingTermFit::Sign::kFree)
      .Contradicted();
}

}  // namespace armcal
