#include "calib/diagnose/select/fit.h"

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/select/chosen.h"
#include "calib/diagnose/select/contact_events.h"
#include "calib/diagnose/select/form_error.h"
#include "calib/diagnose/select/growth.h"
#include "calib/diagnose/select/null.h"
#include "calib/diagnose/select/pulse_events.h"
#include "calib/diagnose/select/redundant.h"
#include "calib/diagnose/select/reference.h"
#include "calib/diagnose/select/returning_events.h"
#include "calib/diagnose/select/unknown_law.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostEvents = 12;
constexpr std::uint64_t kSeed = 1;  // of what chance would give

}  // namespace

GapFit::GapFit(const GapBaseline& baseline, const GapFitOptions& options,
               std::vector<GapSegment> training,
               std::vector<GapSegment> reference)
    : options_(options),
      regression_(baseline, options.bandwidth_hz, std::move(training),
                  std::move(reference)),
      pool_(&regression_, options.without) {}

std::vector<GapEvent> GapFit::NewContacts(
    const std::vector<GapCandidate>& effects, ContactSearch search) const {
  if (IsLeftOut(ContactEffect())) return {};
  return ContactsGiven(regression_, effects, events_, search);
}

bool GapFit::TakeOut(const std::vector<GapEvent>& found) {
  MaskEvents(found, data());
  events_.insert(events_.end(), found.begin(), found.end());
  return !found.empty();
}

// Contacts given the chosen effects, looked for twice. Columns are of small
// effects on a grid of shapes, and what a large one leaves beyond its column is
// no contact; so that contacts have to stand out from the effects as fitted
// too, for which the cheap search decides whether the fit is worth it.
bool GapFit::TakeOutContacts(ContactSearch search) {
  const std::vector<GapCandidate> effects = pool_.Fitted(selection_.chosen);
  std::vector<GapEvent> found = NewContacts(effects, search);
  if (!found.empty() && !effects.empty()) {
    found = NewContacts(Fitted(effects).effects, search);
  }
  return TakeOut(found);
}

// The same of pulses on joints. Where none stands out from chosen effects, some
// may from the model without them: a push is larger than most of what lasts,
// and one that was not known when effects were chosen brings in some that are
// none. An effect that
// is one explains them, and they are forgotten in the end (EventsGiven).
bool GapFit::TakeOutPulses() {
  if (IsLeftOut(ContactEffect())) return false;
  if (HaveNoiseOfPositions(rows().segments())) return false;
  const std::vector<GapCandidate> effects = pool_.Fitted(selection_.chosen);
  std::vector<GapEvent> found = FindPulses(regression_, effects);
  if (!found.empty() && !effects.empty()) {
    found = FindPulses(regression_, Fitted(effects).effects);
  }
  if (found.empty() && !effects.empty()) found = FindPulses(regression_, {});
  return TakeOut(found);
}

RefinedEffects GapFit::Fitted(const std::vector<GapCandidate>& effects) const {
  return RefineEffects(screen(), baseline(), scale(), effects, -1, data());
}

void GapFit::MakeScreen() {
  regression_.Refit();
  constexpr ContactSearch kAtRest = ContactSearch::kAtRest;
  while (options_.selection.events && TakeOut(NewContacts({}, kAtRest))) {
    regression_.Refit();
  }
  pool_.List();
}

// What GrowEffects finds once zeros of torques that have moved are free, and
// without what stands for an effect that each joint has.
std::vector<int> GapFit::Grown() {
  while (true) {
    const Growth growth =
        GrowEffects(candidates(), options_.selection, &regression_);
    if (growth.other_zeros) {
      regression_.FreeZeros();
      MakeScreen();
    } else if (growth.looks_like_it >= 0) {
      pool_.Bar(growth.looks_like_it);
    } else {
      return growth.effects;
    }
  }
}

// Effects given the noise that they leave, where that is not known. A choice
// needs a noise and the noise needs a choice: GrowEffects starts it, by odds
// that compare models under their own variances, and SelectEffects is repeated
// with the noise of its own last answer until the choice stays as it is.
void GapFit::SelectWithTheirNoise() {
  constexpr int kRounds = 3;
  if (!rows().has_evidence()) {
    selection_ = SelectEffects(screen(), candidates(), options_.selection);
    return;
  }
  std::vector<int> before = Grown();
  for (int round = 0; round < kRounds; ++round) {
    selection_ = SelectEffects(screen(), candidates(), options_.selection);
    if (std::is_permutation(before.begin(), before.end(),
                            selection_.chosen.begin(),
                            selection_.chosen.end())) {
      return;
    }
    before = selection_.chosen;
    regression_.SettleEvidence(ColumnsOf(candidates(), before));
  }
}

// Effects, and again with the shapes and sizes that fit best: what the nearest
// of a grid left is no effect of its own. A first choice is made under the
// noise that it leaves, by which the size of the discrepancy is chosen, which
// changes the weights and so asks for another choice. Then the shapes of the
// chosen ones are fitted, kRounds times at most; candidates at these shapes are
// added to the pool, and the choice is made again, until the same places come
// out. What was chosen for its column alone leaves the pool instead.
void GapFit::Select() {
  constexpr int kRounds = 2, kMostBarred = 4;
  const auto select = [this] {
    selection_ = SelectEffects(screen(), candidates(), options_.selection);
  };
  SelectWithTheirNoise();
  if (regression_.ChooseDiscrepancy(
          ColumnsOf(candidates(), selection_.chosen))) {
    MakeScreen();
    SelectWithTheirNoise();
  }
  for (int round = 0, barred = 0; round < kRounds;) {
    const std::vector<GapCandidate> chosen = pool_.Fitted(selection_.chosen);
    if (std::none_of(chosen.begin(), chosen.end(), HasShape)) return;
    const RefinedEffects refined = Fitted(chosen);
    const int hollow = FindHollow(
        screen(), candidates(), selection_, refined,
        [&](size_t k) { return Fitted(AllBut(chosen, k)).delta_chi2; });
    if (hollow >= 0 && barred++ < kMostBarred) {
      pool_.Bar(selection_.chosen[hollow]);
      select();
      continue;
    }
    pool_.Sharpen(refined.effects);
    const std::vector<int> before = selection_.chosen;
    select();
    ++round;
    if (selection_.chosen.size() == before.size() &&
        std::is_permutation(before.begin(), before.end(),
                            selection_.chosen.begin(), [this](int a, int b) {
                              return SamePlace(candidates()[a],
                                               candidates()[b]);
                            })) {
      return;
    }
  }
}

// Fits the event that was chosen, k-th of the selection, and takes it out of
// the data. A force larger than levers allow (largest_force) is no force at the
// tool: then the event is told by what the excess over friction says of its
// window, and its own estimates are not believed. delta_chi2 and score stay
// those that it was chosen by.
void GapFit::TakeOutEvent(size_t k) {
  GapEvent event;
  const RefinedEffects refined = Fitted({pool_.Fitted(selection_.chosen)[k]});
  // By its tails alone any force fits: then it is where it was chosen.
  const TimeRange best = WindowOf(refined.effects[0]);
  const bool is_told =
      !IsKnown(events_, refined.effects[0].log, (best.begin + best.end) / 2);
  const GapCandidate& fitted =
      is_told ? refined.effects[0] : candidates()[selection_.chosen[k]];
  event.contact =
      DescribeContact(baseline().robot(), rows(), ExcessGiven(regression_, {}),
                      fitted.log, WindowOf(fitted));
  event.contact.window = WindowOf(fitted);
  if (is_told && fitted.p.head<3>().norm() < event.contact.largest_force) {
    event.fitted = {fitted, refined.covariance};
    event.contact.force = {fitted.p.head<3>(),
                           refined.covariance.topLeftCorner<3, 3>()};
  }
  event.delta_chi2 = selection_.delta_chi2[k];
  event.score = selection_.scores[k];
  event.one_joint = OneJointShare(screen(), rows(), event);
  data()->Mask(event.contact.log, event.contact.window);
  events_.push_back(event);
}

// Chi squared that a selection and the events so far leave, plus the penalties
// of both. Samples in an event's window are not believed any more, which is
// worth as much as if each of them had been fitted, and its force, time and
// duration are parameters of its own.
double GapFit::Cost(const Selection& selection) const {
  constexpr int kParametersOfAnEvent = 5;  // force, time and duration
  double cost =
      screen().ResidualGiven(JointRows(rows().num_joints())).squaredNorm() -
      TotalDeltaChi2(screen(), candidates(), selection.chosen);
  for (const int c : selection.chosen)
    cost += Penalty(screen(), candidates()[c]);
  for (const GapEvent& event : events_) {
    cost += RowsOf(rows(), event) +
            kParametersOfAnEvent * std::log(rows().num_rows());
  }
  return cost;
}

// Selects again as if nothing had been a touch while the arm moved, where
// effects that last explain more than touches do: what lasts may look like a
// series of these. Both are weighed by the noise that the larger model leaves,
// which has the touches; noise of their own would make the cost of the better
// one the larger.
void GapFit::ForgetTouchesOfWhatLasts() {
  const std::vector<GapEvent> all = events_, contacts = BeyondFriction(all);
  if (contacts.size() == all.size()) return;
  const double touches = Cost(selection_);
  const VectorXd noise = rows().evidence();
  TakeAsKnown(contacts);
  MakeScreen();
  regression_.WeighBy(noise);
  SelectionOptions options = options_.selection;
  options.events = false;
  if (Cost(SelectEffects(screen(), candidates(), options)) < touches) {
    SelectGiven(contacts);
  } else {
    TakeAsKnown(all);
    MakeScreen();
    Select();
  }
}

void GapFit::TakeAsKnown(const std::vector<GapEvent>& events) {
  events_ = events;
  data()->Unmask();
  MaskEvents(events_, data());
}

void GapFit::SelectGiven(const std::vector<GapEvent>& events) {
  TakeAsKnown(events);
  options_.selection.events = false;
  MakeScreen();
  Select();
}

// Effects, and events one by one.
void GapFit::SelectWithEvents() {
  while (true) {
    MakeScreen();
    Select();
    const auto event =
        std::find_if(selection_.chosen.begin(), selection_.chosen.end(),
                     [&](int c) { return candidates()[c].log >= 0; });
    if (event != selection_.chosen.end() &&
        static_cast<int>(events_.size()) < kMostEvents) {
      TakeOutEvent(event - selection_.chosen.begin());
    } else if (!TakeOutContacts(ContactSearch::kOfTwoJoints) &&
               !TakeOutContacts(ContactSearch::kInMotion) && !TakeOutPulses()) {
      break;
    }
  }
  ForgetTouchesOfWhatLasts();
  ForgetEventsOfALaw();
  ConfirmTouches(regression_, pool_.Fitted(selection_.chosen), &events_);
}

// Selects again without what comes back with the motion, and without the pulses
// of joints that are likelier to lack a law.
void GapFit::ForgetEventsOfALaw() {
  for (const auto without : {WithoutReturning, WithoutPulsesOfUnknownLaws}) {
    const std::vector<GapEvent> kept =
        without(regression_, pool_.Fitted(selection_.chosen), events_);
    if (kept.size() < events_.size()) SelectGiven(kept);
  }
}

// The events without pulses that stood out given what was chosen when they were
// found, and do not given these effects.
std::vector<GapEvent> GapFit::EventsGiven(
    const std::vector<GapCandidate>& effects) const {
  if (effects.empty() ||
      std::none_of(events_.begin(), events_.end(),
                   [](const GapEvent& event) { return event.pulse; })) {
    return events_;
  }
  return WithoutExplainedPulses(regression_, effects, events_);
}

void GapFit::FindEvents() {
  SelectWithEvents();
  if (regression_.IsTheSameDayGiven(pool_.Fitted(selection_.chosen))) {
    SelectWithEvents();
  }
  DescribeAgain(baseline().robot(), rows(), ExcessGiven(regression_, {}),
                ExcessGiven(regression_, pool_.Fitted(selection_.chosen)),
                &events_);
}

void GapFit::Choose() {
  FindEvents();
  Finish();
  const std::vector<GapEvent> kept = EventsGiven(refined_.effects);
  if (kept.size() == events_.size()) return;
  SelectGiven(kept);
  Finish();
}

// What is left of the selection after chance (WithoutChance), with shapes that
// are fitted and without effects that have nothing left to do once they are.
// Leaving one out changes what the others explain, so that it is asked again
// until none is.
void GapFit::Finish() {
  selection_ = WithoutChance(screen(), rows(), candidates(), options_.selection,
                             selection_, kSeed);
  while (true) {
    Refine();
    const int redundant = FindRedundant(regression_, pool_, options_.selection,
                                        selection_, refined_);
    if (redundant < 0) break;
    selection_ = DescribeSelection(screen(), candidates(), options_.selection,
                                   Without(selection_.chosen, redundant));
  }
  FitModels();
}

// The models, and what they leave, given the refined effects.
void GapFit::FitModels() {
  const MatrixXd left = data()->ResidualWith(
      refined_.baseline, regression_.TorqueOf(refined_.effects));
  model_refit_ = ModelGiven({});
  model_after_ = ModelGiven(refined_.effects);
  left_.resize(left.cols());
  for (int j = 0; j < left.cols(); ++j) {
    left_[j] = rows().Whiten(j, left.col(j));
  }
}

void GapFit::Exchange(int k, int candidate) {
  selection_.chosen[k] = candidate;
  refined_.effects[k] = pool_.Fitted(selection_.chosen)[k];
}

// The fit with these effects alone, as a report shows it: candidates, rivals
// and baseline are of the model that is claimed and of no other. Nothing is
// chosen anew, which could bring another effect back in.
void GapFit::KeepOnly(const std::vector<int>& kept) {
  std::vector<int> chosen;
  std::vector<Rivals> rivals;
  std::vector<GapCandidate> effects;
  for (const int k : kept) {
    chosen.push_back(selection_.chosen[k]);
    rivals.push_back(rivals_[k]);
    effects.push_back(refined_.effects[k]);
  }
  selection_ = DescribeSelection(screen(), candidates(), options_.selection,
                                 std::move(chosen));
  rivals_ = std::move(rivals);
  refined_ = RefinedEffects();
  refined_.baseline = refit();
  if (!effects.empty()) {
    refined_ = Fitted(effects);
  }
  FitModels();
}

void GapFit::Refine() {
  rivals_.clear();
  for (size_t k = 0; k < selection_.chosen.size(); ++k) {
    rivals_.push_back(CompareRivals(regression_, pool_, options_.selection,
                                    selection_, static_cast<int>(k)));
    selection_.chosen[k] = rivals_[k].best;
  }
  refined_.effects = pool_.Fitted(selection_.chosen);
  refined_.baseline = refit();
  if (refined_.effects.size() == 1 && rivals_[0].refined) {
    refined_ = *rivals_[0].refined;
  } else if (!refined_.effects.empty()) {
    refined_ = Fitted(refined_.effects);
  }
}

VectorXd GapFit::BaselineGiven(const std::vector<GapCandidate>& effects) const {
  return regression_.BaselineGiven(regression_.TorqueOf(effects));
}

VectorXd GapFit::ModelGiven(const std::vector<GapCandidate>& effects) const {
  return regression_.ModelGiven(regression_.TorqueOf(effects));
}

VectorXd GapFit::LeftByNoise(int joint, bool with_effects) const {
  const VectorXd x = with_effects ? refined_.baseline : refit();
  const JointRows torque = with_effects ? regression_.TorqueOf(refined_.effects)
                                        : JointRows(rows().num_joints());
  return rows().WhitenByNoise(joint,
                              data()->ResidualWith(x, torque).col(joint));
}

}  // namespace armcal
