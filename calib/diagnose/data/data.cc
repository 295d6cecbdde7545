#include "calib/diagnose/data/data.h"

#include <algorithm>

#include "calib/diagnose/data/thresholds.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNothing = 1e3;

// A sample of extra variance is in the whitened rows of all that follow it
// within the noise's memory, and filters spread it as far before. Torques that
// are recorded have more noise than that.
MatrixXd Spread(const MatrixXd& extra_stddev) {
  constexpr Eigen::Index kReach = Autoregression::kOrder;
  MatrixXd spread = extra_stddev;
  for (Eigen::Index k = 0; k < extra_stddev.rows(); ++k) {
    const Eigen::Index first = std::max<Eigen::Index>(0, k - kReach);
    const Eigen::Index last = std::min(extra_stddev.rows() - 1, k + kReach);
    spread.row(k) =
        extra_stddev.middleRows(first, last - first + 1).colwise().maxCoeff();
  }
  return spread;
}

}  // namespace

// Everything about the logs that does not depend on which rows count is
// computed once: thinned residual, thinned columns and each sample's usual
// extra deviation. The latter is where friction changes sign, a share of what
// the columns of widths (a half and twice the usual one) would do there. What
// is filtered over kOrder samples reaches that far, which only reconstructed
// torques are exact enough to show (Spread).
GapData::GapData(std::vector<GapSegment> segments, const GapBaseline& baseline,
                 double bandwidth_hz, LogPart part)
    : signals_(std::make_shared<Signals>()),
      num_columns_(baseline.size()),
      prior_(baseline.prior()) {
  signals_->segments = std::move(segments);
  rows_ = std::make_unique<GapRows>(signals_->segments, bandwidth_hz, part);
  torques_ = RecordedTorques(baseline, *rows_);
  signals_->residual = rows_->ThinAll(FineResidual());
  columns_ =
      std::make_shared<const Columns>(baseline.ThinColumns(*rows_, torques_));
  MatrixXd& usual = signals_->usual_extra_stddev;
  usual = MatrixXd::Zero(residual().rows(), residual().cols());
  for (int c = 0; c < baseline.size(); ++c) {
    const BaselineColumn& column = baseline.columns()[c];
    if (!column.IsZeroVelocityWidth()) continue;
    auto extra_stddev = usual.col(column.joint);
    extra_stddev =
        extra_stddev.cwiseMax(columns()[column.joint].Column(c).cwiseAbs());
  }
  for (size_t i = 0; i < signals_->segments.size(); ++i) {
    const int s = static_cast<int>(i), begin = rows_->thin_begin(s);
    auto here = usual.middleRows(begin, rows_->thin_begin(s + 1) - begin);
    const bool reconstructed = signals_->segments[i].reconstructed_torque;
    here *= Limits().reversal_extra_stddev;
    if (reconstructed) here = Spread(here);
  }
  for (size_t i = 0; i < signals_->segments.size(); ++i) {
    for (const TimeRange& lost : signals_->segments[i].lost) {
      const double reach = 1 / bandwidth_hz;  // of the low pass
      MaskIn(static_cast<int>(i), {lost.begin - reach, lost.end + reach},
             &usual);
    }
  }
  Unmask();
}

GapData::GapData(const GapData& other, LogPart part)
    : signals_(other.signals_),
      rows_(std::make_unique<GapRows>(signals_->segments,
                                      other.rows_->bandwidth_hz(), part)),
      torques_(other.torques_),
      columns_(other.columns_),
      num_columns_(other.num_columns_),
      prior_(other.prior_),
      extra_stddev_(other.extra_stddev_) {}

std::vector<MatrixXd> GapData::FineResidual() const {
  std::vector<MatrixXd> residual;
  for (size_t s = 0; s < torques_.size(); ++s) {
    residual.push_back(signals_->segments[s].tau - torques_[s].nominal());
  }
  return residual;
}

MatrixXd GapData::ResidualWith(const VectorXd& x) const {
  return ResidualWith(x, std::vector<VectorXd>(rows_->num_joints()));
}

MatrixXd GapData::ResidualWith(const VectorXd& x,
                               const std::vector<VectorXd>& torque) const {
  MatrixXd residual = signals_->residual;
  for (int j = 0; j < rows_->num_joints(); ++j) {
    residual.col(j) -= columns()[j].Times(x);
    if (torque[j].size() > 0) residual.col(j) -= torque[j];
    residual.col(j) = rows_->WithoutDrift(j, residual.col(j));
  }
  return residual;
}

void GapData::MoveFrictionByDelays(const GapBaseline& baseline,
                                   const VectorXd& x) {
  for (RecordedTorque& torque : torques_) {
    torque.SetBeyondNominal(baseline.FrictionBeyond(x, torque));
  }
}

void GapData::SetNoise(std::vector<Autoregression> noise) {
  rows_->SetNoise(std::move(noise), extra_stddev_);
}

void GapData::SetEvidence(const VectorXd& stddev) {
  rows_->SetEvidence(stddev, extra_stddev_);
}

void GapData::ScaleEvidence(const VectorXd& factor) {
  rows_->ScaleEvidence(factor);
}

void GapData::ScaleColumns(int first, double factor) {
  Columns scaled = *columns_;
  for (BaselineColumns& columns : scaled) {
    for (size_t k = 0; k < columns.which.size(); ++k) {
      if (columns.which[k] >= first) columns.values.col(k) *= factor;
    }
  }
  columns_ = std::make_shared<const Columns>(std::move(scaled));
}

void GapData::Hold(int column) {
  Columns held = *columns_;
  for (size_t j = 0; j < held.size(); ++j) {
    const VectorXd values = held[j].Column(column);
    if (values.size() > 0) held_[column][static_cast<int>(j)] = values;
    held[j].Remove(column);
  }
  columns_ = std::make_shared<const Columns>(std::move(held));
}

void GapData::Free(int column) {
  Columns freed = *columns_;
  for (const auto& [joint, values] : held_[column]) {
    freed[joint].Insert(column, values);
  }
  held_.erase(column);
  columns_ = std::make_shared<const Columns>(std::move(freed));
}

void GapData::Distrust(const MatrixXd& extra_stddev) {
  for (MatrixXd* all : {&signals_->usual_extra_stddev, &extra_stddev_}) {
    *all = (all->cwiseAbs2() + extra_stddev.cwiseAbs2()).cwiseSqrt();
  }
}

void GapData::Mask(int log, const TimeRange& window) {
  for (size_t i = 0; i < signals_->segments.size(); ++i) {
    if (signals_->segments[i].log != log) continue;
    MaskIn(static_cast<int>(i), window, &extra_stddev_);
  }
}

// A masked sample has an extra deviation so large (kNothing times all of the
// residual) that its row says nothing, and its neighbours stay as they are:
// rows are removed without the ones around them being whitened anew.
void GapData::MaskIn(int segment, const TimeRange& window,
                     MatrixXd* extra_stddev) const {
  const int end = rows_->thin_begin(segment + 1);
  for (int k = rows_->thin_begin(segment); k < end; ++k) {
    if (!window.Contains(rows_->thin_time(segment, k))) continue;
    extra_stddev->row(k) = kNothing * residual().colwise().norm();
  }
}

void GapData::Unmask() { extra_stddev_ = signals_->usual_extra_stddev; }

std::vector<bool> GapData::Masked() const {
  const Eigen::ArrayXd least =
      kNothing * residual().colwise().norm().transpose().array();
  std::vector<bool> masked(rows_->num_thin(), false);
  for (int k = 0; k < rows_->num_thin() && least.sum() > 0; ++k) {
    masked[k] = (extra_stddev_.row(k).transpose().array() >= least).all();
  }
  return masked;
}

std::vector<BaselineColumns> GapData::WhitenedColumns() const {
  std::vector<BaselineColumns> white;
  for (int j = 0; j < rows_->num_joints(); ++j) {
    const BaselineColumns& own = columns()[j];
    white.push_back({own.which, rows_->Whiten(j, own.values)});
  }
  return white;
}

GapScreen GapData::Screen(int columns) const {
  std::vector<BaselineColumns> white = WhitenedColumns();
  for (BaselineColumns& own : white) own.KeepFirst(columns);
  return GapScreen(std::move(white), columns, WhitenedResidual(), prior_);
}

std::vector<VectorXd> GapData::WhitenedResidual() const {
  std::vector<VectorXd> white;
  for (int j = 0; j < rows_->num_joints(); ++j) {
    white.push_back(rows_->Whiten(j, residual().col(j)));
  }
  return white;
}

}  // namespace armcal
