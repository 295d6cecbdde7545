#include "calib/diagnose/select/regression.h"

#include <numeric>

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/position_noise.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/select/reference_noise.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// With the model's columns alone; 0 for others.
VectorXd RefitModel(const GapBaseline& baseline, const GapData& data) {
  GapScreen screen = data.Screen(baseline.num_model_columns());
  screen.Factor();
  VectorXd x = VectorXd::Zero(baseline.size());
  x.head(baseline.num_model_columns()) =
      screen.BaselineBeside(JointRows(data.rows().num_joints()));
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

GapRegression::GapRegression(const GapBaseline& baseline, double bandwidth_hz,
                             std::vector<GapSegment> training, LogPart part,
                             std::vector<GapSegment> reference)
    : baseline_(baseline),
      data_(std::make_unique<GapData>(std::move(training), baseline,
                                      bandwidth_hz, part)) {
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
  }
  EstimateNoise();
  scale_ = ScaleOf(baseline, data_->rows(), data_->torques());
}

GapRegression::GapRegression(const GapRegression& other, LogPart part)
    : baseline_(other.baseline_),
      data_(std::make_unique<GapData>(*other.data_, part)),
      reference_(other.reference_),
      noise_(other.noise_),
      scale_(other.scale_),
      discrepancy_(other.discrepancy_),
      discrepancy_chosen_(true) {
  data_->ScaleColumns(baseline_.num_model_columns(), discrepancy_);
  EstimateNoise();
}

void GapRegression::EstimateNoise() {
  before_ = VectorXd::Zero(baseline_.size());
  if (reference_) {
    reference_->SetNoise(noise_.joints);
    SettleReference();
  } else if (noise_.source != NoiseFloor::kPositions) {
    data_->SetNoise(WhiteNoise(data_->residual()));
    noise_ =
        EstimateGapNoise(data_->rows(), data_->FineResidual(),
                         data_->ResidualWith(RefitModel(baseline_, *data_)));
  }
  data_->SetNoise(noise_.joints);
}

void GapRegression::SettleReference() {
  if (noise_.source != NoiseFloor::kPositions) {
    const VectorXd start = Start(*reference_);
    reference_->SetEvidence(start);
    GapScreen screen = reference_->Screen();
    screen.Factor();
    reference_->SetEvidence(SettleNoise(std::move(screen), start).stddev());
  }
  before_ = RefitModel(baseline_, *reference_);
}

void GapRegression::Refit() {
  data_->SetNoise(noise_.joints);
  const bool of_positions = noise_.source == NoiseFloor::kPositions;
  if (!of_positions) data_->SetEvidence(Start(*data_));
  screen_.emplace(data_->Screen());
  if (reference_) {
    screen_->AddKnown(reference_->WhitenedColumns(),
                      reference_->WhitenedResidual());
  }
  screen_->Factor();
  SettleEvidence({});
  refit_ = screen_->BaselineBeside(JointRows(data_->rows().num_joints()));
  if (HoldDays()) Refit();
}

bool GapRegression::ChooseDiscrepancy(const std::vector<int>& columns) {
  const double least = Limits().least_lacked;
  const int first = baseline_.num_model_columns();
  if (discrepancy_chosen_ || first == baseline_.size()) return false;
  discrepancy_chosen_ = true;
  const GapScreen screen = screen_->Only(columns);
  std::vector<int> lacked(baseline_.size() - first);
  std::iota(lacked.begin(), lacked.end(), first);
  double most = LogEvidence(screen, evidence_);
  for (const double size : {3 * least, least}) {
    GapScreen scaled = screen;
    scaled.ScaleBaseline(lacked, size);
    const double evidence = LogEvidence(std::move(scaled), evidence_);
    if (evidence <= most) continue;
    most = evidence;
    discrepancy_ = size;
  }
  if (discrepancy_ == 1) return false;
  data_->ScaleColumns(first, discrepancy_);
  if (reference_) {
    reference_->ScaleColumns(first, discrepancy_);
    SettleReference();
  }
  return true;
}

void GapRegression::SettleEvidence(const std::vector<int>& columns) {
  if (noise_.source == NoiseFloor::kPositions) return;
  evidence_ = SettleNoise(screen_->Only(columns), data_->rows().evidence());
  WeighBy(evidence_.stddev());
}

void GapRegression::WeighBy(const VectorXd& stddev) {
  if (noise_.source == NoiseFloor::kPositions) return;
  const VectorXd before = data_->rows().evidence();
  data_->ScaleEvidence(stddev.cwiseQuotient(before));
  screen_->Weigh(before.cwiseQuotient(stddev));
  refit_ = screen_->BaselineBeside(JointRows(data_->rows().num_joints()));
}

// What changed on one joint or two only is to be explained, not absorbed; so is
// what changed by more than from day to day where others did not change with
// it. Whether a column is held now that was not.
bool GapRegression::HoldDays() {
  constexpr double kUsual = 3;  // standard deviations
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
    any |= held_.insert(c).second;
    data_->Hold(c);
  }
  return any;
}

// An effect of the whole robot may have looked like another day.
bool GapRegression::IsTheSameDayBeside(
    const std::vector<GapCandidate>& effects) {
  if (!another_day_.value_or(false) || effects.empty()) return false;
  another_day_ = IsAnotherDay(baseline_, BaselineBeside(TorqueOf(effects)),
                              screen_->BaselineCovariance());
  return !*another_day_;
}

ReferenceScatter GapRegression::ScatterOf(const GapCandidate& effect) const {
  if (!reference_) return {};
  return ScatterBetweenLogs(baseline_, scale_, effect, refit_,
                            reference_.get());
}

JointRows GapRegression::TorqueOf(
    const std::vector<GapCandidate>& effects) const {
  return EffectTorque(baseline_, scale_, effects, data_.get());
}

VectorXd GapRegression::ModelBeside(const JointRows& torque) const {
  return screen_->BaselineBeside(WhitenEach(data_->rows(), torque),
                                 baseline_.num_model_columns());
}

VectorXd GapRegression::BaselineBeside(const JointRows& torque) const {
  return screen_->BaselineBeside(WhitenEach(data_->rows(), torque));
}

}  // namespace armcal
