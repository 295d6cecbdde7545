#include "tests/blind/effect_size.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// s; as much as an autoregression needs.
constexpr double kNoiseDuration = 24;
constexpr double kReferenceRateHz = 50;

MatrixXd Stacked(const MatrixXd& x) {
  return Eigen::Map<const MatrixXd>(x.data(), x.size(), 1);
}

// With noise, but sampled as without: their difference is taken by sample.
Scenario NoisyScenario(const BlindCase& blind) {
  Scenario scenario = BlindScenario(blind, BlindLog::kTraining, {});
  scenario.loop.sensors.jitter = 0;
  scenario.loop.sensors.lost_share = 0;
  scenario.motion.duration = std::min(scenario.motion.duration, kNoiseDuration);
  return scenario;
}

}  // namespace

EffectSize SizeOf(const VectorXd& d, long n, const Absorption& absorption) {
  const Absorption::Left left = absorption.Of(d);
  const long rows = d.size() / n;
  EffectSize size;
  size.raw = d.norm() / std::sqrt(rows);
  size.enr = std::sqrt(std::max(0.0, left.squared) / rows);
  size.joint_enr.resize(n);
  for (int j = 0; j < n; ++j) {
    size.joint_enr[j] = left.residual.segment(j * rows, rows).norm();
  }
  if (size.joint_enr.norm() > 0) {
    size.joint_enr *= size.enr / size.joint_enr.norm();
  }
  return size;
}

CaseNoise::CaseNoise(const BlindCase& blind, QuietRuns* training) {
  const auto noisy = SimulateResidual(blind, NoisyScenario(blind));
  CHECK(noisy) << "an arm without effects follows";
  const MatrixXd& all = *training->Residual({});
  const MatrixXd quiet = all.topRows(noisy->torque.rows());
  const MatrixXd noise = noisy->torque - quiet;
  for (int j = 0; j < noise.cols(); ++j) {
    noise_.push_back(ResidualNoise::Fit(noise.col(j)));
  }
  floor_ = noise.colwise().squaredNorm().transpose() / noise.rows();
  const MatrixXd columns =
      Whitened(AbsorbingColumns(blind, training->Motion()));
  known_gradient_ = VectorXd::Zero(columns.cols());
  if (blind.has_reference) Know(blind);
  absorption_ = std::make_unique<Absorption>(columns, known_);
}

// Along the motion that the reference log was to follow, the true robot's
// torque is the file's and the columns' times what is to be known.
void CaseNoise::Know(const BlindCase& blind) {
  const PlantMotion motion = MotionOf(
      QuietScenario(blind, BlindLog::kReference, {}).motion, kReferenceRateHz);
  const MatrixXd columns = Whitened(AbsorbingColumns(blind, motion));
  known_ = columns.transpose() * columns;
  known_gradient_ = columns.transpose() * White(FileError(blind, motion));
}

MatrixXd CaseNoise::Whitened(const MatrixXd& stacked) const {
  const long n = noise_.size(), rows = stacked.rows() / n;
  const long left = rows - ResidualNoise::kOrder;
  MatrixXd white(left * n, stacked.cols());
  for (int j = 0; j < n; ++j) {
    white.middleRows(j * left, left) =
        noise_[j].Whiten(stacked.middleRows(j * rows, rows));
  }
  return white;
}

VectorXd CaseNoise::White(const MatrixXd& residual) const {
  return Whitened(Stacked(residual));
}

EffectSizer::EffectSizer(const BlindCase& blind)
    : training_(blind, BlindLog::kTraining),
      noise_(std::make_unique<CaseNoise>(blind, &training_)) {}

std::optional<EffectSize> EffectSizer::SizeOfLast(
    const std::vector<ChosenEffect>& effects) {
  const MatrixXd* with = training_.Residual(effects);
  if (!with) return std::nullopt;
  const MatrixXd* without =
      training_.Residual({effects.begin(), effects.end() - 1});
  if (!without) return std::nullopt;
  return SizeOf(noise_->White(*with - *without), with->cols(),
                noise_->absorption());
}

std::optional<std::vector<EffectSize>> EffectSizer::Sizes(
    const std::vector<ChosenEffect>& effects) {
  std::vector<EffectSize> sizes;
  const MatrixXd* all = training_.Residual(effects);
  if (!all) return std::nullopt;
  for (size_t k = 0; k < effects.size(); ++k) {
    std::vector<ChosenEffect> others = effects;
    others.erase(others.begin() + k);
    const MatrixXd* without = training_.Residual(others);
    if (!without) return std::nullopt;
    sizes.push_back(SizeOf(noise_->White(*all - *without), all->cols(),
                           noise_->absorption()));
  }
  return sizes;
}

std::optional<std::vector<EffectSize>> EffectSizes(const BlindCase& blind) {
  return EffectSizer(blind).Sizes(blind.effects);
}

}  // namespace armcal
