#include "calib/gap_families.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/gap_candidates.h"
#include "calib/gap_data.h"
#include "calib/gap_screen.h"
#include "calib/gap_selection.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Term {
  const char* effect;
  JointTerm term;
  double Joint::*value;
};

const std::vector<Term> kTerms = {
    {"viscous_friction", JointTerm::kViscous, &Joint::viscous},
    {"coulomb_friction", JointTerm::kCoulomb, &Joint::coulomb},
    {"armature", JointTerm::kArmature, &Joint::armature},
    {"torque_offset", JointTerm::kOffset, &Joint::offset}};

bool IsLacked(const Robot& robot, const Term& term) {
  return std::all_of(
      robot.links.begin(), robot.links.end(),
      [&](const Link& link) { return link.joint.*term.value == 0; });
}

// A candidate per joint and lacked term, family after family.
std::vector<GapCandidate> Candidates(const Robot& robot,
                                     const std::vector<Term>& terms,
                                     const MotionScale& scale) {
  std::vector<GapCandidate> candidates;
  for (const Term& term : terms) {
    const Effect* effect = FindEffect(term.effect);
    CHECK(effect != nullptr && effect->parameters.size() == 1) << term.effect;
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
            const std::vector<Term>& terms)
      : robot_(robot),
        terms_(terms),
        baseline_(robot, options, UsualTorque(segments)),
        data_(segments, baseline_, bandwidth_hz) {
    scale_ = ScaleOf(baseline_, data_.rows(), data_.torques());
    candidates_ = Candidates(robot, terms, scale_);
    EvaluateCandidates(baseline_, data_.rows(), scale_, data_.mutable_torques(),
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
  }

  LackedFamilies Result() const {
    LackedFamilies result;
    result.robot = robot_;
    result.without = Left(0);
    const GapScreen::Fit all = Solve(static_cast<int>(terms_.size()));
    const int n = robot_.num_joints();
    for (size_t f = 0; f < terms_.size(); ++f) {
      LackedFamily family;
      family.effect = candidates_[f * n].effect;
      family.term = terms_[f].term;
      family.value.resize(n);
      family.stddev.resize(n);
      std::vector<int> others;
      for (size_t c = 0; c < candidates_.size(); ++c) {
        if (c / n != f) others.push_back(static_cast<int>(c));
      }
      family.drop =
          all.drop - screen_->Solve(ColumnsOf(candidates_, others)).drop;
      family.left = Left(static_cast<int>(f) + 1);
      for (int j = 0; j < n; ++j) {
        const int c = static_cast<int>(f) * n + j;
        const double size = candidates_[c].size[0];
        family.value[j] = all.coefficients[c] * size;
        family.stddev[j] = std::sqrt(all.covariance(c, c)) * size;
        result.robot.links[j].joint.*terms_[f].value =
            terms_[f].term == JointTerm::kOffset
                ? family.value[j]
                : std::max(family.value[j], 1e-6 * size);
      }
      result.families.push_back(family);
    }
    return result;
  }

 private:
  void Weigh() {
    data_.SetNoise(noise_);
    screen_.emplace(data_.WhitenedColumns(), data_.WhitenedResidual());
    AddCandidates(data_.rows(), &candidates_, &*screen_);
    screen_->Factor();
  }
  // With the first `families` of them.
  GapScreen::Fit Solve(int families) const {
    std::vector<int> chosen(families * robot_.num_joints());
    for (size_t k = 0; k < chosen.size(); ++k) chosen[k] = static_cast<int>(k);
    return screen_->Solve(ColumnsOf(candidates_, chosen));
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
  std::vector<Term> terms_;
  GapBaseline baseline_;
  GapData data_;
  MotionScale scale_;
  std::vector<GapCandidate> candidates_;
  std::vector<Autoregression> noise_;
  std::optional<GapScreen> screen_;
};

}  // namespace

LackedFamilies FitLackedFamilies(const Robot& robot,
                                 const BaselineOptions& options,
                                 double bandwidth_hz,
                                 const std::vector<GapSegment>& segments) {
  std::vector<Term> lacked;
  // Offsets are in no robot file: they are only fitted beside others.
  for (const Term& term : kTerms) {
    const bool alone = term.term == JointTerm::kOffset && lacked.empty();
    if (!alone && IsLacked(robot, term)) lacked.push_back(term);
  }
  LackedFamilies none;
  none.robot = robot;
  if (lacked.empty()) return none;
  return FamilyFit(robot, options, bandwidth_hz, segments, lacked).Result();
}

}  // namespace armcal
