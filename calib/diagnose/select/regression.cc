#include "calib/diagnose/select/regression.h"

#include <numeric>

#include "calib/diagnose/candidates/effect_odds.h"
#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/motion_range.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/position_noise.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/reference_folds.h"
#include "calib/diagnose/select/reference_noise.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard deviations of a change from log to log that is usual.
constexpr double kUsual = 3;

// The model's own columns alone, those of the discrepancy held at 0: what a
// robot file can hold, as it is before anything is diagnosed.
GapScreen ModelScreen(const GapBaseline& baseline, const GapData& data) {
  GapScreen screen = data.Screen(baseline.num_model_columns());
  screen.Factor();
  return screen;
}

VectorXd RefitModel(const GapBaseline& baseline, const GapData& data) {
  const GapScreen screen = ModelScreen(baseline, data);
  VectorXd x = VectorXd::Zero(baseline.size());
  x.head(baseline.num_model_columns()) =
      screen.BaselineGiven(JointRows(data.rows().num_joints()));
  return x;
}

// White noise of what a robot as its file has it leaves.
VectorXd Start(const GapData& data) {
  const std::vector<Autoregression> noise = WhiteNoise(data.residual());
  VectorXd stddev(noise.size());
  for (size_t j = 0; j < noise.size(); ++j) stddev[j] = noise[j].sigma;
  return stddev;
}

}  // namespace

// The noise of the torque is told first, from the best source that there is: of
// reconstructed torques from a draw of their positions' noise, else from a
// reference (which holds what a model leaves where nothing is wrong), else from
// the log's own repeats and rests. A reference is fitted with the discrepancy
// left out for that purpose, since it would take up what is to be measured;
// columns of the day are held in it, so that they are the difference between
// the days.
GapRegression::GapRegression(const GapBaseline& baseline, double bandwidth_hz,
                             std::vector<GapSegment> training,
                             std::vector<GapSegment> reference)
    : baseline_(baseline),
      data_(std::make_unique<GapData>(std::move(training), baseline,
                                      bandwidth_hz)) {
  const bool of_positions = HaveNoiseOfPositions(data_->rows().segments()) &&
                            HaveNoiseOfPositions(reference);
  if (of_positions) noise_ = NoiseOfPositions(baseline, data_->rows());
  if (!reference.empty()) {
    if (!of_positions) {
      noise_ = ReferenceNoise(baseline.WithoutDiscrepancy(), bandwidth_hz,
                              reference);
    }
    reference_ =
        std::make_shared<GapData>(std::move(reference), baseline, bandwidth_hz);
    for (const int c : DayColumns(baseline)) reference_->Hold(c);
    for (const int c : ZeroColumns(baseline)) reference_->Hold(c);
  }
  for (const int c : ZeroColumns(baseline)) data_->Hold(c);
  holds_zeros_ = !ZeroColumns(baseline).empty();
  EstimateNoise();
  scale_ = ScaleOf(baseline, data_->rows(), data_->torques());
}

// Everything but values is taken over: a part that weighed rows or held columns
// otherwise would be another model, and what that predicts says nothing of this
// one.
GapRegression::GapRegression(const GapRegression& other, LogPart part)
    : baseline_(other.baseline_),
      data_(other.DataOf(part)),
      reference_(other.reference_),
      noise_(other.noise_),
      evidence_(other.evidence_),
      scale_(other.scale_),
      discrepancy_(other.discrepancy_),
      discrepancy_chosen_(true),
      another_day_(other.another_day_),
      held_(other.held_),
      changed_together_(other.changed_together_),
      holds_zeros_(other.holds_zeros_),
      before_(other.before_) {
  MakeScreen();
  refit_ = screen_->BaselineGiven(JointRows(data_->rows().num_joints()));
}

std::unique_ptr<GapData> GapRegression::DataOf(LogPart part) const {
  auto data = std::make_unique<GapData>(*data_, part);
  GiveNoise(data.get());
  return data;
}

std::unique_ptr<GapData> GapRegression::DataOf(
    std::vector<GapSegment> logs) const {
  auto data = std::make_unique<GapData>(std::move(logs), baseline_,
                                        rows().bandwidth_hz());
  data->ScaleColumns(baseline_.num_model_columns(), discrepancy_);
  if (reference_) data->MoveFrictionByDelays(baseline_, before_);
  DistrustOtherMotion(data.get());
  GiveNoise(data.get());
  return data;
}

// Errors of a model that a reference left are those of motion as the reference
// has it. Of faster motion they are as much larger as MotionRange says of
// friction's curve and of inertias, which is no change since the reference.
void GapRegression::DistrustOtherMotion(GapData* data) const {
  if (!reference_ || noise_.source == NoiseFloor::kPositions) return;
  const Eigen::ArrayXXd growth =
      MotionRange(reference_->rows()).OwnGrowth(data->rows());
  MatrixXd extra_stddev(growth.rows(), growth.cols());
  for (int j = 0; j < growth.cols(); ++j) {
    extra_stddev.col(j) = noise_.joints[j].stddev() *
                          (growth.col(j).square() - 1).sqrt().matrix();
  }
  data->Distrust(extra_stddev);
}

void GapRegression::GiveNoise(GapData* data) const {
  data->SetNoise(noise_.joints);
  if (rows().has_evidence()) data->SetEvidence(rows().evidence());
}

// The diagnosed rows, with the reference's as known data of the baseline: both
// have the same x but for columns of the day and of time.
void GapRegression::MakeScreen() {
  screen_.emplace(data_->Screen());
  if (reference_) {
    screen_->AddKnown(reference_->WhitenedColumns(),
                      reference_->WhitenedResidual());
  }
  screen_->Factor();
}

bool GapRegression::has_several_references() const {
  return reference_ && AreSeveralLogs(reference_->rows().segments());
}

// The noise and the baseline's values before these logs. Without a reference a
// refit with white noise comes first, whose residual is then looked at where
// the motion repeats or rests (noise.h); differences between repeats do not
// depend on how good that fit is.
void GapRegression::EstimateNoise() {
  before_ = VectorXd::Zero(baseline_.size());
  if (reference_) {
    reference_->SetNoise(noise_.joints);
    SettleReference();
    reference_->MoveFrictionByDelays(baseline_, before_);
    data_->MoveFrictionByDelays(baseline_, before_);
  } else if (noise_.source != NoiseFloor::kPositions) {
    data_->SetNoise(WhiteNoise(data_->residual()));
    noise_ =
        EstimateGapNoise(data_->rows(), data_->FineResidual(),
                         data_->ResidualWith(RefitModel(baseline_, *data_)));
  }
  DistrustOtherMotion(data_.get());
  data_->SetNoise(noise_.joints);
}

// The reference is weighed by what the baseline leaves of it, variance and
// correlation both (SettleNoise), not by the noise of the torque: parameters
// are as uncertain as the misfit around them says, and a reference weighed by
// noise alone would hold them far too tightly in the diagnosed log.
void GapRegression::SettleReference() {
  if (noise_.source != NoiseFloor::kPositions) {
    WeighReference();
    if (discrepancy_ < 1) {
      const int first = baseline_.num_model_columns();
      reference_->ScaleColumns(first, discrepancy_);
      data_->ScaleColumns(first, discrepancy_);
      WeighReference();
    }
  }
  before_ = RefitModel(baseline_, *reference_);
}

MatrixXd GapRegression::CovarianceBefore() const {
  const int columns = baseline_.num_model_columns();
  if (!reference_) return MatrixXd::Zero(columns, columns);
  return ModelScreen(baseline_, *reference_).BaselineCovariance();
}

// Once the size of what models lack is told as well.
void GapRegression::WeighReference() {
  const VectorXd start = Start(*reference_);
  reference_->SetEvidence(start);
  GapScreen screen = reference_->Screen();
  screen.Factor();
  const EvidenceNoise noise = SettleNoise(screen, start);
  reference_->SetEvidence(noise.stddev());
  const bool is_told = baseline_.num_model_columns() == baseline_.size();
  if (is_told || discrepancy_chosen_) return;
  discrepancy_chosen_ = true;
  discrepancy_ = LikeliestDiscrepancy(screen, noise);
}

// The screen is weighed by what an empty selection leaves; SettleEvidence does
// so again as effects are taken in. Where columns of the day turn out to have
// no place (HoldDays) they are held and all is done once more.
void GapRegression::Refit() {
  data_->SetNoise(noise_.joints);
  const bool of_positions = noise_.source == NoiseFloor::kPositions;
  if (!of_positions) data_->SetEvidence(Start(*data_));
  MakeScreen();
  SettleEvidence({});
  refit_ = screen_->BaselineGiven(JointRows(data_->rows().num_joints()));
  const bool days = HoldDays(), offsets = HoldOffsets(), zeros = HoldZeros();
  if (days || offsets || zeros) Refit();
}

// The standard deviations of what models lack as a rule are those of an average
// robot, and some robots are better. One factor a for all of them is chosen by
// the evidence, the marginal likelihood with the coefficients integrated out
// (type II maximum likelihood, Good 1965; MacKay 1992),
//   a = argmax log p(r | a),  a in {1, 3 least, least}.
// It is never above 1: a discrepancy that may grow swallows effects. The factor
// multiplies the columns, so that their prior stays N(0, 1).
double GapRegression::LikeliestDiscrepancy(const GapScreen& screen,
                                           const EvidenceNoise& noise) const {
  const double least = Limits().least_discrepancy;
  const int first = baseline_.num_model_columns();
  std::vector<int> discrepancy(baseline_.size() - first);
  std::iota(discrepancy.begin(), discrepancy.end(), first);
  return LikeliestScale(screen, noise, discrepancy, {1, 3 * least, least});
}

// A reference tells it where there is one: nothing in it is wrong, and what is
// wrong in the diagnosed logs, a push most of all, would pass for what models
// lack. Else the effects that are chosen so far are given, lest a small size be
// refused because one is missing.
bool GapRegression::ChooseDiscrepancy(const std::vector<int>& columns) {
  const int first = baseline_.num_model_columns();
  if (discrepancy_chosen_ || first == baseline_.size()) return false;
  discrepancy_chosen_ = true;
  discrepancy_ = LikeliestDiscrepancy(screen_->Only(columns), evidence_);
  if (discrepancy_ == 1) return false;
  data_->ScaleColumns(first, discrepancy_);
  return true;
}

double GapRegression::DiscrepancyOn(int j) const {
  return discrepancy_ *
         baseline_.discrepancy().Deviation(j, baseline_.robot().links[j].joint);
}

void GapRegression::SettleEvidence(const std::vector<int>& columns) {
  if (noise_.source == NoiseFloor::kPositions) return;
  evidence_ = SettleNoise(screen_->Only(columns), data_->rows().evidence());
  WeighBy(evidence_.stddev());
}

// Rows are whitened by dividing them by their standard deviations, so that new
// ones are a factor on each joint's rows, of the data and of the screen's
// products alike: no row is touched again.
void GapRegression::WeighBy(const VectorXd& stddev) {
  if (noise_.source == NoiseFloor::kPositions) return;
  const VectorXd before = data_->rows().evidence();
  data_->ScaleEvidence(stddev.cwiseQuotient(before));
  screen_->Weigh(before.cwiseQuotient(stddev));
  refit_ = screen_->BaselineGiven(JointRows(data_->rows().num_joints()));
}

// Which columns of the day stay free. They are viscous and Coulomb friction of
// the diagnosed logs beside that of the reference, with the scatter from day to
// day as their prior (days.h). Where no other day shows at all, or a change is
// of one joint or two, or beyond kUsual deviations of that scatter without
// others that changed with it, the change is held at 0: it is to be explained
// by an effect and not absorbed. The others stay free. The answer is whether a
// column is held now that was not, so that the regression has to be done anew.
bool GapRegression::HoldDays() {
  const std::vector<int> days = DayColumns(baseline_);
  if (days.empty()) return false;
  if (!another_day_) {
    another_day_ =
        IsAnotherDay(baseline_, refit_, screen_->BaselineCovariance());
  }
  bool any = false;
  if (*another_day_ && held_.empty()) {
    for (const JointTerm term : {JointTerm::kViscous, JointTerm::kCoulomb}) {
      const auto changed = ChangedTogether(baseline_, term, refit_,
                                           screen_->BaselineCovariance());
      changed_together_.insert(changed.begin(), changed.end());
    }
  }
  for (const int c : days) {
    const bool is_usual =
        std::abs(refit_[c]) < kUsual || changed_together_.count(c) > 0;
    if (*another_day_ && is_usual) continue;
    any |= HoldNow(c);
  }
  return any;
}

// Whether it was not held before.
bool GapRegression::HoldNow(int column) {
  const bool is_new = held_.insert(column).second;
  if (is_new) data_->Hold(column);
  return is_new;
}

// An offset of a joint's torque is one number of all logs, and differs from log
// to log. Where a reference's logs differ in it, they hardly tell it, and it
// would follow the diagnosed log wherever that is. What is beyond kUsual
// deviations of its prior is a change since the reference: held at 0 in the
// diagnosed logs, to be explained by an effect.
bool GapRegression::HoldOffsets() {
  if (!reference_) return false;
  bool any = false;
  for (int c = 0; c < baseline_.num_model_columns(); ++c) {
    const BaselineColumn& column = baseline_.columns()[c];
    const bool is_offset =
        column.kind == BaselineColumn::Kind::kTerm &&
        static_cast<JointTerm>(column.index) == JointTerm::kOffset;
    if (!is_offset || std::abs(refit_[c]) < kUsual) continue;
    any |= HoldNow(c);
  }
  return any;
}

void GapRegression::FreeZeros() {
  for (const int c : ZeroColumns(baseline_)) data_->Free(c);
  holds_zeros_ = false;
}

// Of zeros that have moved, those that moved by more than the others do are to
// be explained by an effect.
bool GapRegression::HoldZeros() {
  if (holds_zeros_) return false;
  bool any = false;
  for (const int c : BeyondTheOthers(baseline_, refit_)) any |= HoldNow(c);
  return any;
}

// An effect of the whole robot may have looked like another day.
bool GapRegression::IsTheSameDayGiven(
    const std::vector<GapCandidate>& effects) {
  if (!another_day_.value_or(false) || effects.empty()) return false;
  another_day_ = IsAnotherDay(baseline_, BaselineGiven(TorqueOf(effects)),
                              screen_->BaselineCovariance());
  return !*another_day_;
}

ReferenceScatter GapRegression::ScatterOf(const GapCandidate& effect) const {
  if (!reference_) return {};
  const auto scatter_of = [&](const GapCandidate& one) {
    return ScatterBetweenLogs(baseline_, scale_, one, refit_, reference_.get());
  };
  const ReferenceScatter own = scatter_of(effect);
  if (effect.joint < 0 || !has_several_references()) return own;
  std::vector<ReferenceScatter> others;
  for (int j = 0; j < rows().num_joints(); ++j) {
    const EffectSite site = {&baseline_.robot(), j, &scale_};
    const auto& unfit = effect.effect->unfit;
    if (j == effect.joint || (unfit && !unfit(site).empty())) continue;
    GapCandidate other = effect;
    other.joint = j;
    others.push_back(scatter_of(other));
  }
  return PooledScatter(own, others);
}

// The reference's rows with the diagnosed ones as known data of the baseline,
// the other way round than in MakeScreen. Numbers of the reference's own could
// make up for an effect that it does not have: what they leave of a delay is
// hardly more than what they leave without one. The numbers that the diagnosed
// logs have, given the effect, do not.
ShareOfEffect GapRegression::ShareInReference(const GapCandidate& effect,
                                              const JointRows& all) const {
  if (!reference_) return {};
  JointRows target = data_->WhitenedResidual();
  const JointRows torque = WhitenEach(data_->rows(), all);
  for (size_t j = 0; j < target.size(); ++j) {
    if (torque[j].size() > 0) target[j] -= torque[j];
  }
  GapScreen screen = reference_->Screen();
  screen.AddKnown(data_->WhitenedColumns(), target);
  return ShareIn(baseline_, scale_, effect, std::move(screen),
                 reference_.get());
}

bool GapRegression::CouldHaveLost(const GapCandidate& effect,
                                  const std::vector<GapCandidate>& all) const {
  if (!reference_ || !effect.is_change) return true;
  if (effect.effect->nature != Effect::Nature::kLaw) return true;
  const bool is_backwards =
      effect.effect->parameters[0].sign == EffectParameter::Sign::kPositive &&
      effect.p[0] < 0;
  return !is_backwards || ShareInReference(effect, TorqueOf(all)).CouldBeLost();
}

JointRows GapRegression::TorqueOf(
    const std::vector<GapCandidate>& effects) const {
  return EffectTorque(baseline_, scale_, effects, data_.get());
}

VectorXd GapRegression::ModelGiven(const JointRows& torque) const {
  return screen_->BaselineGiven(WhitenEach(data_->rows(), torque),
                                baseline_.num_model_columns());
}

VectorXd GapRegression::BaselineGiven(const JointRows& torque) const {
  return screen_->BaselineGiven(WhitenEach(data_->rows(), torque));
}

}  // namespace armcal
