#include "calib/diagnose/select/regression.h"

#include <cmath>

#include "calib/diagnose/data/days.h"
#include "calib/diagnose/data/motion_scale.h"
#include "calib/diagnose/data/position_noise.h"
#include "calib/diagnose/select/reference.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd RefitBaseline(const GapData& data) {
  GapScreen screen(data.WhitenedColumns(), data.WhitenedResidual());
  screen.Factor();
  return screen.BaselineBeside(JointRows(data.rows().num_joints()));
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
      noise_ = ReferenceNoise(baseline, bandwidth_hz, reference);
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
      scale_(other.scale_) {
  EstimateNoise();
}

void GapRegression::EstimateNoise() {
  before_ = VectorXd::Zero(baseline_.size());
  if (reference_) {
    reference_->SetNoise(noise_.joints);
    before_ = RefitBaseline(*reference_);
  } else if (noise_.source != NoiseFloor::kPositions) {
    data_->SetNoise(WhiteNoise(data_->residual()));
    noise_ = EstimateGapNoise(data_->rows(), data_->FineResidual(),
                              data_->ResidualWith(RefitBaseline(*data_)));
  }
  data_->SetNoise(noise_.joints);
}

void GapRegression::Refit() {
  data_->SetNoise(noise_.joints);
  screen_.emplace(data_->WhitenedColumns(), data_->WhitenedResidual());
  if (reference_) AddReference(*reference_, &*screen_);
  screen_->Factor();
  refit_ = screen_->BaselineBeside(JointRows(data_->rows().num_joints()));
  if (HoldDays()) Refit();
}

// What changed by more than from day to day, or on one joint or two only, is to
// be explained, not absorbed. Whether a column is held now that was not.
bool GapRegression::HoldDays() {
  constexpr double kUsual = 3;  // standard deviations
  const std::vector<int> days = DayColumns(baseline_);
  if (!days.empty() && !another_day_) {
    another_day_ =
        IsAnotherDay(baseline_, refit_, screen_->BaselineCovariance());
  }
  bool any = false;
  for (const int c : days) {
    if (*another_day_ && std::abs(refit_[c]) < kUsual) continue;
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

JointRows GapRegression::TorqueOf(
    const std::vector<GapCandidate>& effects) const {
  return EffectTorque(baseline_, scale_, effects, data_.get());
}

VectorXd GapRegression::BaselineBeside(const JointRows& torque) const {
  return screen_->BaselineBeside(WhitenEach(data_->rows(), torque));
}

}  // namespace armcal
