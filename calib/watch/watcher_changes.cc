#include <algorithm>
#include <cmath>
#include <utility>

#include "calib/watch/watcher.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = WatchEvent::Kind;

constexpr size_t kMostBlocks = 64;  // that changes are looked for in: 16 s
constexpr size_t kFoldedTogether = 16;
// Jeffreys: a Bayes factor of 20 is strong evidence for one against another.
const double kClearlyOver = std::log(20.);
// After a change was told: blocks that are folded together, and how long, s.
constexpr size_t kSoon = 4;
constexpr double kLearnSoon = 16;
constexpr double kUnclear = 2;  // s, after which it is said that it is unclear

}  // namespace

// All that was learned from, against the calibration. What is told first is
// then known, as another change may be there beside it.
void Watcher::CompareWithCalibration(const RowInformation& all, double t) {
  constexpr int kMostChanges = 4;
  ParameterBelief before = belief_;
  before.covariance += null_->wander;
  for (int round = 0; round < kMostChanges; ++round) {
    const MatrixXd root = CovarianceRoot(before.covariance);
    const ChangeTest test(all, before, root);
    std::vector<ChangeEvidence> evidence;
    for (const WatchHypothesis& change : hypotheses_) {
      if (change.kind == WatchHypothesis::Kind::kContact) continue;
      evidence.push_back(test.Of(change));
    }
    const auto best = std::max_element(
        evidence.begin(), evidence.end(),
        [](const auto& a, const auto& b) { return a.log_bayes < b.log_bayes; });
    if (best->log_bayes < null_->log_bayes_threshold) return;
    const size_t h = best - evidence.begin();
    const bool payload = hypotheses_[h].kind == WatchHypothesis::Kind::kPayload;
    WatchEvent event{payload ? Kind::kPayload : Kind::kFriction,
                     t,
                     first_,
                     {},
                     ValuesOf(h, *best),
                     best->log_bayes,
                     true,
                     ""};
    if (!payload) {
      event.joints = {model_.robot.links[hypotheses_[h].joint].joint.name};
    }
    events_(event);
    lasting_.push_back({h, first_, before, root, all});
    before.covariance = WithChange(before.covariance, hypotheses_[h],
                                   hypotheses_[h].stddev.cwiseAbs2());
  }
}

void Watcher::EndBlock(double t) {
  blocks_.push_back(
      std::exchange(block_, RowInformation(model_.columns() + 6)));
  if (!lasting_.empty() && !contact_) lasting_.back().since.Add(blocks_.back());
  Decide(t);
  // What a change has made uncertain is learned soon.
  if (!contact_ && t < learn_soon_until_ && blocks_.size() >= 2 * kSoon) {
    Fold(kSoon);
  }
  if (blocks_.size() < kMostBlocks + kFoldedTogether) return;
  if (contact_) {
    blocks_.erase(blocks_.begin(), blocks_.begin() + kFoldedTogether);
  } else {
    Fold(kFoldedTogether);
  }
}

// The oldest blocks go into the belief, which wanders meanwhile.
void Watcher::Fold(size_t count) {
  if (count == 0) return;
  RowInformation all(model_.columns() + 6);
  for (size_t k = 0; k < count; ++k) all.Add(blocks_[k]);
  blocks_.erase(blocks_.begin(), blocks_.begin() + count);
  ParameterBelief wandered = belief_;
  wandered.covariance +=
      null_->wander * std::min(1., (all.end - all.begin) / options_.memory_s);
  SetBelief(Updated(wandered, all));
}

void Watcher::Decide(double t) {
  if (blocks_.empty()) return;
  RowInformation window(model_.columns() + 6);
  std::vector<ChangeEvidence> best;
  double most = -1, onset = t;
  const size_t oldest = std::min(blocks_.size(), kMostBlocks);
  size_t k = 0;
  for (size_t length = 1; length <= oldest; length *= 2) {
    for (; k < length; ++k) window.Add(blocks_[blocks_.size() - 1 - k]);
    const ChangeTest test(window, belief_, root_);
    std::vector<ChangeEvidence> evidence;
    double largest = 0;
    for (const WatchHypothesis& change : hypotheses_) {
      evidence.push_back(test.Of(change));
      largest = std::max(largest, evidence.back().log_bayes);
    }
    if (largest <= most) continue;
    most = largest;
    best = std::move(evidence);
    onset = window.begin;
  }
  if (slow_contact_ && most < 0) return EndContact(t);
  if (most < null_->log_bayes_threshold) {
    if (!contact_) unclear_since_ = -1;
    return;
  }
  if (unclear_since_ < 0) unclear_since_ = t;
  DecideBetween(t, contact_ ? contact_onset_ : onset, best);
}

// The likeliest has to be clearly so, and against a cause that has more numbers
// to explain with not only because it has fewer: its estimate fits clearly
// better.
void Watcher::DecideBetween(double t, double onset,
                            const std::vector<ChangeEvidence>& evidence) {
  const auto best = std::max_element(
      evidence.begin(), evidence.end(),
      [](const auto& a, const auto& b) { return a.log_bayes < b.log_bayes; });
  bool clear = true;
  for (const ChangeEvidence& other : evidence) {
    if (&other == &*best) continue;
    const bool simpler = other.theta.size() > best->theta.size();
    clear = clear && best->log_bayes - other.log_bayes >= kClearlyOver &&
            (!simpler ||
             best->log_likelihood - other.log_likelihood >= kClearlyOver);
  }
  if (clear) {
    Tell(t, onset, best - evidence.begin(), *best);
  } else if (t - unclear_since_ >= kUnclear) {
    TellUndecided(t, onset);
  }
}

void Watcher::TellUndecided(double t, double onset) {
  if (undecided_told_) return;
  undecided_told_ = true;
  events_({Kind::kUndecided,
           t,
           onset,
           {},
           {},
           0,
           false,
           "payload, friction or contact: more motion tells them apart"});
}

void Watcher::Tell(double t, double onset, size_t hypothesis,
                   const ChangeEvidence& evidence) {
  const WatchHypothesis& change = hypotheses_[hypothesis];
  WatchEvent event{
      Kind::kPayload,     t,     onset, {}, ValuesOf(hypothesis, evidence),
      evidence.log_bayes, false, ""};
  if (change.kind == WatchHypothesis::Kind::kContact) {
    if (contact_) return;  // it was told when it began
    event.kind = Kind::kContact;
    event.text = "it lasts";
    contact_ = slow_contact_ = true;
    contact_onset_ = onset;
    events_(event);
    return;
  }
  if (change.kind == WatchHypothesis::Kind::kFriction) {
    event.kind = Kind::kFriction;
    event.joints = {model_.robot.links[change.joint].joint.name};
  }
  if (contact_) event.text = "which is what the contact was";
  events_(event);
  Accept(hypothesis, onset);
}

// Blocks before the change are of the robot as it was, those after it of the
// changed one.
void Watcher::Accept(size_t hypothesis, double onset) {
  size_t before = 0;
  while (before < blocks_.size() && blocks_[before].end < onset) ++before;
  Fold(before);
  lasting_.push_back({hypothesis, onset, belief_, root_,
                      RowInformation(model_.columns() + 6)});
  for (const RowInformation& block : blocks_) lasting_.back().since.Add(block);
  const WatchHypothesis& change = hypotheses_[hypothesis];
  SetBelief({belief_.mean, WithChange(belief_.covariance, change,
                                      change.stddev.cwiseAbs2())});
  if (!blocks_.empty()) learn_soon_until_ = blocks_.back().end + kLearnSoon;
  Fold(blocks_.size());
  contact_ = slow_contact_ = undecided_told_ = false;
  unclear_since_ = -1;
}

}  // namespace armcal
