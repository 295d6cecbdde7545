#include "calib/gap_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "calib/gap_null.h"
#include "calib/gap_reference.h"
#include "calib/motion_scale.h"
#include "model/effects/effects.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostEvents = 12;
constexpr std::uint64_t kSeed = 1;  // of what chance would give

VectorXd RefitBaseline(const GapData& data) {
  GapScreen screen(data.WhitenedColumns(), data.WhitenedResidual());
  screen.Factor();
  return screen.BaselineBeside(JointRows(data.rows().num_joints()));
}

std::vector<int> DayColumns(const GapBaseline& baseline) {
  std::vector<int> columns;
  for (int c = 0; c < baseline.size(); ++c) {
    if (baseline.columns()[c].kind == BaselineColumn::Kind::kDay) {
      columns.push_back(c);
    }
  }
  return columns;
}

void AddReference(const GapData& before, GapScreen* screen) {
  const std::vector<MatrixXd> A = before.WhitenedColumns();
  const std::vector<VectorXd> y = before.WhitenedResidual();
  MatrixXd AtA = MatrixXd::Zero(A[0].cols(), A[0].cols());
  VectorXd Aty = VectorXd::Zero(A[0].cols());
  for (size_t j = 0; j < A.size(); ++j) {
    AtA += A[j].transpose() * A[j];
    Aty += A[j].transpose() * y[j];
  }
  screen->AddInformation(AtA, Aty);
}

}  // namespace

GapFit::GapFit(const GapBaseline& baseline, const GapFitOptions& options,
               std::vector<GapSegment> training, LogPart part,
               std::vector<GapSegment> reference)
    : baseline_(baseline), options_(options) {
  const double hz = options.bandwidth_hz;
  data_ = std::make_unique<GapData>(std::move(training), baseline, hz, part);
  if (!reference.empty()) {
    noise_ = ReferenceNoise(baseline, hz, reference);
    reference_ = std::make_unique<GapData>(std::move(reference), baseline, hz);
    for (const int c : DayColumns(baseline)) reference_->Hold(c);
  }
  EstimateNoise();
  scale_ = ScaleOf(baseline, data_->rows(), data_->torques());
}

void GapFit::EstimateNoise() {
  before_ = VectorXd::Zero(baseline_.size());
  if (reference_) {
    reference_->SetNoise(noise_.joints);
    before_ = RefitBaseline(*reference_);
  } else {
    data_->SetNoise(WhiteNoise(data_->residual()));
    noise_ = EstimateGapNoise(data_->rows(), data_->FineResidual(),
                              data_->ResidualWith(RefitBaseline(*data_)));
  }
  data_->SetNoise(noise_.joints);
}

void GapFit::Refit() {
  data_->SetNoise(noise_.joints);
  screen_.emplace(data_->WhitenedColumns(), data_->WhitenedResidual());
  if (reference_) AddReference(*reference_, &*screen_);
  screen_->Factor();
  refit_ = screen_->BaselineBeside(JointRows(data_->rows().num_joints()));
  if (HoldDays()) Refit();
}

// On another day friction differs on several joints, somewhat. What changed by
// more, or on one joint or two only, is to be explained, not absorbed. Whether
// a column is held now that was not.
bool GapFit::HoldDays() {
  constexpr double kUsual = 3, kClear = 5;  // standard deviations
  constexpr int kSeveral = 3;               // joints; all of smaller arms
  const std::vector<int> days = DayColumns(baseline_);
  if (!days.empty() && !another_day_) {
    const MatrixXd covariance = screen_->BaselineCovariance();
    std::set<int> changed;
    for (const int c : days) {
      if (std::abs(refit_[c]) > kClear * std::sqrt(covariance(c, c))) {
        changed.insert(baseline_.columns()[c].joint);
      }
    }
    another_day_ = static_cast<int>(changed.size()) >=
                   std::min(kSeveral, baseline_.robot().num_joints());
  }
  bool any = false;
  for (const int c : days) {
    if (*another_day_ && std::abs(refit_[c]) < kUsual) continue;
    any |= held_.insert(c).second;
    data_->Hold(c);
  }
  return any;
}

// What the baseline and effects leave of the torque beyond friction.
FrictionExcess GapFit::ExcessBeside(
    const std::vector<GapCandidate>& effects) const {
  const JointRows torque =
      EffectTorque(baseline_, scale_, effects, false, data_.get());
  const VectorXd x = screen_->BaselineBeside(WhitenEach(data_->rows(), torque));
  return ExcessOverFriction(baseline_, x, data_->rows(),
                            data_->ResidualWith(x, torque));
}

// Above what the excess of a log without a contact is: of the reference, or of
// the log itself but for a few windows.
double GapFit::UsualExcess(const FrictionExcess& excess, bool of_itself) const {
  const GapRows& rows = data_->rows();
  const GapRows& before = reference_ ? reference_->rows() : rows;
  const double block = BlockTime(before);
  const std::vector<double> own = BlockMaxima(rows, block, excess.Largest());
  const double further = static_cast<double>(own.size());
  double usual = 0;
  if (of_itself) usual = PredictedUsualMaximum(own, further, kFalseContacts);
  if (!reference_) return usual;
  const FrictionExcess known = ExcessOverFriction(
      baseline_, refit_, before, reference_->ResidualWith(refit_));
  return std::max(usual,
                  PredictedMaximum(BlockMaxima(before, block, known.Largest()),
                                   further, kFalseContacts));
}

// Contacts stand out from all that friction does when nothing touches the arm,
// which only a reference tells. What one joint alone feels in motion may be its
// own: where the arm has no other, it has to stand out from the rest of the log
// as well. Whether there were any.
bool GapFit::TakeOutContacts(const std::vector<GapCandidate>& effects,
                             ContactSearch search) {
  const bool of_itself = search == ContactSearch::kInMotion;
  if (IsLeftOut(*FindEffect("external_contact"))) return false;
  if (of_itself ? data_->rows().num_joints() > 1 : !reference_) return false;
  const FrictionExcess excess = ExcessBeside(effects);
  const double usual = UsualExcess(excess, of_itself);
  bool any = false;
  for (const Contact& contact :
       FindContacts(baseline_.robot(), data_->rows(), excess, usual, search)) {
    if (std::any_of(events_.begin(), events_.end(), [&](const GapEvent& event) {
          return event.contact.log == contact.log &&
                 event.contact.window.Contains(contact.time);
        })) {
      continue;
    }
    events_.push_back(EventBeyondFriction(data_->rows(), excess, contact));
    events_.back().at_rest = search == ContactSearch::kAtRest;
    data_->Mask(contact.log, contact.window);
    any = true;
  }
  return any;
}

void GapFit::MakeScreen() {
  Refit();
  if (candidates_.empty()) {
    while (options_.selection.events &&
           TakeOutContacts({}, ContactSearch::kAtRest)) {
      Refit();
    }
    candidates_ = ListCandidates(baseline_, data_->rows(), scale_,
                                 data_->ResidualWith(refit_), options_.without);
    EvaluateCandidates(baseline_, data_->rows(), scale_,
                       data_->mutable_torques(), &candidates_);
  }
  AddCandidates(data_->rows(), &candidates_, &*screen_);
  screen_->Factor();
  if (AddLargerOnes()) screen_->Factor();
}

// Where effects that are not linear show most, their torques are tried at
// larger sizes as well. Whether there was one.
bool GapFit::AddLargerOnes() {
  constexpr int kPlaces = 3;
  SelectionOptions options = options_.selection;
  options.signs = false;  // a small one may be the opposite of a large one
  VectorXd scores = ScoresBeside(*screen_, candidates_, options, {}, -1);
  for (size_t i = 0; i < candidates_.size(); ++i) {
    if (candidates_[i].effect->larger_sizes.empty()) scores[i] = 0;
  }
  std::vector<GapCandidate> larger;
  for (const int place : BestPlaces(candidates_, scores, kPlaces)) {
    for (const GapCandidate& shape : candidates_) {
      if (!SamePlace(shape, candidates_[place])) continue;
      for (const GapCandidate& one : LargerOnes(shape)) larger.push_back(one);
    }
  }
  EvaluateCandidates(baseline_, data_->rows(), scale_, data_->mutable_torques(),
                     &larger);
  AddCandidates(data_->rows(), &larger, &*screen_);
  candidates_.insert(candidates_.end(), larger.begin(), larger.end());
  return !larger.empty();
}

std::vector<GapCandidate> GapFit::Chosen(const std::vector<int>& which) const {
  std::vector<GapCandidate> chosen;
  const GapScreen::Fit fit = screen_->Solve(ColumnsOf(candidates_, which));
  int at = 0;
  for (const int c : which) {
    chosen.push_back(candidates_[c]);
    GapCandidate& effect = chosen.back();
    for (size_t l = 0; l < effect.linear.size(); ++l) {
      effect.p[effect.linear[l]] = fit.coefficients[at++] * effect.size[l];
    }
  }
  return chosen;
}

void GapFit::TakeOutEvent(size_t k) {
  GapEvent event;
  const RefinedEffects refined =
      RefineEffects(*screen_, baseline_, scale_, {Chosen(selection_.chosen)[k]},
                    -1, data_.get());
  const GapCandidate& fitted = refined.effects[0];
  event.contact =
      DescribeContact(baseline_.robot(), data_->rows(), ExcessBeside({}),
                      fitted.log, WindowOf(fitted));
  event.contact.window = WindowOf(fitted);
  if (fitted.p.head<3>().norm() < event.contact.largest_force) {
    event.fitted = {fitted, refined.covariance};
    event.contact.force = {fitted.p.head<3>(),
                           refined.covariance.topLeftCorner<3, 3>()};
  }
  event.drop = selection_.drops[k];
  event.score = selection_.scores[k];
  event.one_joint = OneJointShare(*screen_, data_->rows(), event);
  data_->Mask(event.contact.log, event.contact.window);
  events_.push_back(event);
  // What else stands out is looked for in what is left.
  candidates_.clear();
}

// chi^2 that a selection and the events so far leave, and what they cost:
// what is not believed any more is as if each row had been fitted.
double GapFit::Cost(const Selection& selection) const {
  constexpr int kParametersOfAnEvent = 5;  // force, time and duration
  double cost = screen_->ResidualBeside(JointRows(data_->rows().num_joints()))
                    .squaredNorm() -
                screen_->Solve(ColumnsOf(candidates_, selection.chosen)).drop;
  for (const int c : selection.chosen) cost += Price(*screen_, candidates_[c]);
  for (const GapEvent& event : events_) {
    cost += RowsOf(data_->rows(), event) +
            kParametersOfAnEvent * std::log(data_->rows().num_rows());
  }
  return cost;
}

// Selects again as if nothing had happened while the arm moved.
void GapFit::ForgetTouches() {
  std::vector<GapEvent> contacts;
  std::copy_if(events_.begin(), events_.end(), std::back_inserter(contacts),
               [](const GapEvent& event) { return event.beyond_friction; });
  SelectBeside(contacts);
}

void GapFit::SelectBeside(const std::vector<GapEvent>& events) {
  events_ = events;
  data_->Unmask();
  for (const GapEvent& event : events_) {
    data_->Mask(event.contact.log, event.contact.window);
  }
  options_.selection.events = false;
  candidates_.clear();
  MakeScreen();
  selection_ = SelectEffects(*screen_, candidates_, options_.selection);
}

// Effects, and events one by one: what lasts may look like a series of
// touches, and has to explain more than they do.
void GapFit::SelectWithEvents() {
  double lasting = std::numeric_limits<double>::infinity();
  while (true) {
    MakeScreen();
    selection_ = SelectEffects(*screen_, candidates_, options_.selection);
    const auto event =
        std::find_if(selection_.chosen.begin(), selection_.chosen.end(),
                     [&](int c) { return candidates_[c].log >= 0; });
    if (event != selection_.chosen.end() &&
        static_cast<int>(events_.size()) < kMostEvents) {
      if (std::isinf(lasting)) {
        SelectionOptions options = options_.selection;
        options.events = false;
        lasting = Cost(SelectEffects(*screen_, candidates_, options));
      }
      TakeOutEvent(event - selection_.chosen.begin());
    } else if (TakeOutContacts(Chosen(selection_.chosen),
                               ContactSearch::kOfTwoJoints) ||
               TakeOutContacts(Chosen(selection_.chosen),
                               ContactSearch::kInMotion)) {
      candidates_.clear();
    } else {
      break;
    }
  }
  if (lasting < Cost(selection_)) ForgetTouches();
}

void GapFit::FindEvents() {
  SelectWithEvents();
  DescribeAgain(baseline_.robot(), data_->rows(), ExcessBeside({}),
                ExcessBeside(Chosen(selection_.chosen)), &events_);
}

void GapFit::Choose() {
  FindEvents();
  Finish();
}

void GapFit::ChooseBeside(const std::vector<GapEvent>& events) {
  SelectBeside(events);
  Finish();
}

void GapFit::Finish() {
  selection_ = WithoutChance(*screen_, data_->rows(), candidates_,
                             options_.selection, selection_, kSeed);
  rivals_.assign(selection_.chosen.size(), {});
  for (size_t k = 0; k < selection_.chosen.size(); ++k) CompareRivals(k);
  refined_.effects = Chosen(selection_.chosen);
  refined_.baseline = refit_;
  if (!refined_.effects.empty()) {
    refined_ = RefineEffects(*screen_, baseline_, scale_, refined_.effects, -1,
                             data_.get());
  }
  const MatrixXd left = data_->ResidualWith(
      refined_.baseline,
      EffectTorque(baseline_, scale_, refined_.effects, false, data_.get()));
  left_.resize(left.cols());
  for (int j = 0; j < left.cols(); ++j) {
    left_[j] = data_->rows().Whiten(j, left.col(j));
  }
}

// A grid may be kinder to one effect than to another: those near the k-th in
// score are compared with their shapes fitted, and the best takes its place.
void GapFit::CompareRivals(size_t k) {
  constexpr int kMostRivals = 3;
  constexpr double kNear = .5;  // of the drop
  VectorXd scores = ScoresBeside(*screen_, candidates_, options_.selection,
                                 selection_.chosen, static_cast<int>(k));
  const double least =
      selection_.scores[k] - std::max(20., kNear * selection_.drops[k]);
  const double by_others =
      screen_
          ->Solve(ColumnsOf(candidates_,
                            Without(selection_.chosen, static_cast<int>(k))))
          .drop;
  double best_score = -1e300;
  int best = selection_.chosen[k];
  while (static_cast<int>(rivals_[k].size()) < 1 + kMostRivals) {
    int c;
    if (!(scores.maxCoeff(&c) >= least)) break;
    const GapCandidate& rival = candidates_[c];
    std::vector<int> chosen = selection_.chosen;
    chosen[k] = c;
    const RefinedEffects refined =
        RefineEffects(*screen_, baseline_, scale_, Chosen(chosen),
                      static_cast<int>(k), data_.get());
    const double score = refined.drop - by_others - Price(*screen_, rival);
    rivals_[k].push_back({rival.effect, rival.joint, score});
    if (score > best_score) best_score = score, best = c;
    for (int i = 0; i < scores.size(); ++i) {
      if (candidates_[i].effect == rival.effect &&
          candidates_[i].joint == rival.joint) {
        scores[i] = -1e300;
      }
    }
  }
  selection_.chosen[k] = best;
}

VectorXd GapFit::BaselineWithout(size_t k) const {
  std::vector<GapCandidate> others = refined_.effects;
  others.erase(others.begin() + k);
  const JointRows torque =
      WhitenEach(data_->rows(),
                 EffectTorque(baseline_, scale_, others, false, data_.get()));
  return screen_->BaselineBeside(torque);
}

}  // namespace armcal
