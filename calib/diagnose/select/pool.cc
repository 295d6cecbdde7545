#include "calib/diagnose/select/pool.h"

#include <algorithm>
#include <iterator>

#include "calib/diagnose/candidates/candidate_torques.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/selection.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

CandidatePool::CandidatePool(GapRegression* regression,
                             std::vector<std::string> without)
    : regression_(*regression), without_(std::move(without)) {}

// Columns are derivatives of the torque at a small size of the effect, which is
// all there is to know of a law that is in proportion to its size. A backlash
// or a wind-up is not: its torque at ten times the size has another course. For
// these larger sizes are candidates of their own, a few for every joint whose
// residual is more than noise, and all sizes and shapes at the places where the
// small ones already score best.
void CandidatePool::List() {
  Forget();
  Add(ListCandidates(regression_.baseline(), regression_.rows(),
                     regression_.scale(),
                     regression_.data()->ResidualWith(regression_.refit()),
                     without_, regression_.reference() != nullptr));
  Add(AFewLargerOnes());
  Add(LargerOnesWhereTheyShow());
}

// What is at all sizes one course that bends (a delay, a wrong zero) is at the
// fitted size from then on: a column of another one, times a factor, is the
// torque of no size, and may fit better than all of them. What rings fits at
// several sizes, and stays in the pool at each.
void CandidatePool::Sharpen(const std::vector<GapCandidate>& fitted) {
  std::vector<GapCandidate> sharper = Sharper(fitted);
  for (const GapCandidate& one : sharper) {
    if (one.effect->larger_sizes.empty() || !one.effect->proportional) continue;
    for (GapCandidate& other : candidates_) {
      if (SamePlace(one, other)) other.least = other.most = 0;
    }
  }
  Add(std::move(sharper));
}

void CandidatePool::Bar(int candidate) {
  for (GapCandidate& other : candidates_) {
    if (SamePlace(candidates_[candidate], other)) other.least = other.most = 0;
  }
}

void CandidatePool::Add(std::vector<GapCandidate> more) {
  if (more.empty()) return;
  Evaluate(&more);
  AddCandidates(regression_.rows(), &more, regression_.mutable_screen());
  candidates_.insert(candidates_.end(), std::make_move_iterator(more.begin()),
                     std::make_move_iterator(more.end()));
  regression_.mutable_screen()->Factor();
}

std::vector<GapCandidate> CandidatePool::Fitted(
    const std::vector<int>& which) const {
  return FittedTo(regression_.screen(), candidates_, which);
}

std::vector<GapCandidate> CandidatePool::AFewLargerOnes() const {
  const std::vector<bool> more = MoreThanNoise();
  const bool any = std::count(more.begin(), more.end(), true) > 0;
  std::vector<GapCandidate> larger;
  for (const int c : UsualShapes(candidates_)) {
    const GapCandidate& candidate = candidates_[c];
    const bool shows = candidate.joint < 0 ? any : more[candidate.joint];
    if (!shows) continue;
    for (const GapCandidate& one : FewLargerOnes(candidate)) {
      larger.push_back(one);
    }
  }
  return larger;
}

// The kPlaces best places by delta_chi2 - penalty of the small candidates
// decide where all larger sizes are evaluated, which costs a simulation each.
// Solve is asked and not the score, since the latter holds coefficients at
// their known sign.
std::vector<GapCandidate> CandidatePool::LargerOnesWhereTheyShow() const {
  constexpr int kPlaces = 3;
  if (std::none_of(candidates_.begin(), candidates_.end(),
                   [](const GapCandidate& one) { return one.is_larger; })) {
    return {};
  }
  // Whatever their sign: a small one may be the opposite of a large one.
  const GapScreen& screen = regression_.screen();
  VectorXd scores = VectorXd::Zero(candidates_.size());
  for (size_t i = 0; i < candidates_.size(); ++i) {
    if (!HasMoreLargerOnes(candidates_[i])) continue;
    scores[i] = screen.Solve(candidates_[i].columns).delta_chi2 -
                Penalty(screen, candidates_[i]);
  }
  std::vector<GapCandidate> larger;
  for (const int place : BestPlaces(candidates_, scores, kPlaces)) {
    for (const GapCandidate& shape : candidates_) {
      if (!SamePlace(shape, candidates_[place]) || shape.is_larger) continue;
      for (const GapCandidate& one : LargerOnes(shape)) larger.push_back(one);
    }
  }
  return larger;
}

std::vector<bool> CandidatePool::MoreThanNoise() const {
  constexpr double kMore = 1.1;  // of the variance
  const MatrixXd left = regression_.data()->ResidualWith(regression_.refit());
  std::vector<bool> more;
  for (int j = 0; j < regression_.rows().num_joints(); ++j) {
    const VectorXd rows = regression_.rows().WhitenByNoise(j, left.col(j));
    more.push_back(rows.squaredNorm() >
                   kMore * static_cast<double>(rows.size()));
  }
  return more;
}

// What a candidate's torque is, events do not change.
void CandidatePool::Evaluate(std::vector<GapCandidate>* candidates) {
  ReuseTorques(&evaluated_, candidates);
  EvaluateCandidates(regression_.baseline(), regression_.rows(),
                     regression_.scale(), regression_.data()->torques(),
                     candidates);
}

std::vector<GapCandidate> CandidatePool::TakeEvaluated() {
  Forget();
  return std::move(evaluated_);
}

void CandidatePool::Forget() {
  evaluated_.insert(evaluated_.end(),
                    std::make_move_iterator(candidates_.begin()),
                    std::make_move_iterator(candidates_.end()));
  candidates_.clear();
  evaluated_.erase(std::remove_if(evaluated_.begin(), evaluated_.end(),
                                  [](const GapCandidate& one) {
                                    return one.torque.empty();
                                  }),
                   evaluated_.end());
}

}  // namespace armcal
