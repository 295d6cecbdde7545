#include "calib/diagnose/judge/held_out.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calib/diagnose/candidates/search.h"
#include "calib/diagnose/data/thresholds.h"
#include "calib/diagnose/judge/contenders.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Seconds that the rows cover, gaps left out.
double TimeOf(const GapRows& rows) {
  double time = 0;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i);
    time += rows.thin_time(s, rows.thin_begin(s + 1) - 1) -
            rows.thin_time(s, rows.thin_begin(s));
  }
  return time;
}

struct LogWindow {
  int log;
  TimeWindow window;
};

// What the largest of so many chi squared of n degrees is below but for 1 %:
// n + 2 sqrt(n L) + 2 L with L = ln(windows / .01) (Laurent and Massart 2000,
// lemma 1).
double LargestByChance(int windows, Eigen::Index n) {
  const double L = std::log(std::max(1, windows) / .01);
  return static_cast<double>(n) + 2 * std::sqrt(n * L) + 2 * L;
}

// The strongest window of .4 to 2 s over all joints (StrongWindows); none where
// that has no more of chi squared than `least` and than chance may give.
// Deviations are NaN where a joint rests, and count as 0.
std::optional<LogWindow> StrongestWindow(const GapRows& rows,
                                         const MatrixXd& deviations,
                                         double least) {
  const std::vector<double> durations = {.4, 1, 2};  // s
  const MatrixXd left =
      deviations.unaryExpr([](double x) { return std::isnan(x) ? 0 : x; });
  std::optional<LogWindow> strongest;
  for (size_t i = 0; i < rows.segments().size(); ++i) {
    const int s = static_cast<int>(i), begin = rows.thin_begin(s);
    const int size = rows.thin_begin(s + 1) - begin;
    VectorXd t(size);
    for (int k = 0; k < size; ++k) t[k] = rows.thin_time(s, begin + k);
    int searched = 0;
    for (const TimeWindow& window : StrongWindows(left.middleRows(begin, size),
                                                  t, durations, 1, &searched)) {
      const double most =
          strongest ? strongest->window.strength
                    : std::max(least, LargestByChance(searched, left.cols()));
      if (window.strength <= most) continue;
      strongest = {rows.segments()[i].log, window};
    }
  }
  return strongest;
}

}  // namespace

MatrixXd Bounded(const MatrixXd& residual) {
  return residual.unaryExpr([](double x) {
    return std::isfinite(x) && std::abs(x) < kUnbounded ? x : kUnbounded;
  });
}

HeldOut::HeldOut(const GapFit& fit, std::uint64_t seed)
    : fit_(fit),
      seed_(seed),
      other_logs_(false),
      every_fold_(fit.regression().DataOf(LogPart::AnyFold())),
      rows_(every_fold_.get()) {
  parts_.resize(LogPart::kFolds);
  const std::vector<int> contenders = Contenders(fit);
  tbb::parallel_for(0, LogPart::kFolds, [&](int fold) {
    parts_[fold].predictor = std::make_unique<Predictor>(fit, fold, contenders);
    parts_[fold].data = fit.regression().DataOf(LogPart::Fold(fold));
  });
  Follow();
}

HeldOut::HeldOut(const GapFit& fit, std::vector<GapSegment> other_logs,
                 std::uint64_t seed)
    : fit_(fit), seed_(seed), other_logs_(true) {
  parts_.push_back({std::make_unique<Predictor>(fit),
                    fit.regression().DataOf(std::move(other_logs)), nullptr});
  Follow();
  rows_ = parts_[0].data.get();
  if (!fit.events().empty()) MaskEvents();
}

// What the fits of all folds look at before they start is worked out once.
void HeldOut::Follow() {
  const std::vector<GapCandidate>& effects = fit_.refined().effects;
  std::vector<JointRows> around;
  if (!other_logs_ && !effects.empty()) {
    around =
        TorquesAround(fit_.baseline(), fit_.scale(), effects, -1, *fit_.data());
  }
  tbb::parallel_for(size_t{0}, parts_.size(),
                    [&](size_t k) { parts_[k].predictor->Follow(around); });
  after_.resize(0, 0);
}

// An arm that was touched in one log may have been in another: windows in which
// what the fitted effects leave stands out as the weakest of the touches did
// are not judged by. What stands out in more than a third of the time was no
// touch.
void HeldOut::MaskEvents() {
  constexpr int kMostWindows = 12;
  GapData* data = parts_[0].data.get();
  const MatrixXd residual =
      Residual(parts_[0], fit_.refined().effects, fit_.model_after());
  double least = std::numeric_limits<double>::infinity();
  for (const GapEvent& touch : fit_.events()) {
    least = std::min(least, touch.delta_chi2);
  }
  double masked = 0;
  for (int round = 0; round < kMostWindows; ++round) {
    const auto worst = StrongestWindow(rows(), Deviations(residual), least);
    if (!worst) return;
    const TimeWindow& window = worst->window;
    masked += 2 * window.duration;
    if (masked > Limits().most_of_time * TimeOf(rows())) return;
    data->Mask(worst->log, {window.centre - window.duration,
                            window.centre + window.duration});
    fit_.regression().GiveNoise(data);
  }
}

MatrixXd HeldOut::ResidualOf(const std::vector<GapCandidate>& effects,
                             const VectorXd& baseline, GapData* data) const {
  return Bounded(data->ResidualWith(
      baseline, EffectTorque(fit_.baseline(), fit_.scale(), effects, data)));
}

MatrixXd HeldOut::Residual(const Part& part,
                           const std::vector<GapCandidate>& effects,
                           const VectorXd& baseline) const {
  GapData* data = part.data.get();
  return ResidualOf(
      other_logs_ ? InTheirPhase(effects, baseline, data) : effects, baseline,
      data);
}

// Thinned samples, each by the part that it is in.
template <typename OfPart>
MatrixXd HeldOut::FromParts(const OfPart& of_part) const {
  MatrixXd all = of_part(parts_[0]);
  for (size_t p = 1; p < parts_.size(); ++p) {
    const MatrixXd own = of_part(parts_[p]);
    const GapRows& part = parts_[p].data->rows();
    for (int k = 0; k < part.num_thin(); ++k) {
      if (part.IsInPart(part.SegmentOf(k), k)) all.row(k) = own.row(k);
    }
  }
  return all;
}

// As effects are in logs that they were not fitted to: what happened once did
// not, and what swings in time swings as much, at a phase of each log's own.
std::vector<GapCandidate> HeldOut::InTheirPhase(
    const std::vector<GapCandidate>& effects, const VectorXd& baseline,
    GapData* data) const {
  std::vector<GapCandidate> here, swinging;
  for (const GapCandidate& effect : effects) {
    if (effect.log >= 0) continue;
    (SwingsInTime(*effect.effect) ? swinging : here).push_back(effect);
  }
  if (swinging.empty()) return here;
  const int logs = segments().empty() ? 0 : segments().back().log + 1;
  for (const GapCandidate& effect : swinging) {
    const MatrixXd residual = ResidualOf(here, baseline, data);
    for (int log = 0; log < logs; ++log) {
      here.push_back(InPhase(effect, log, residual, data));
    }
  }
  return here;
}

// A vibration has its frequency and its amplitude from the fit and its phase
// from each log: that is when the log began. With unit torques of cosine and
// sine, the projection (a, b) of the residual on both, by their 2 x 2 normal
// equations, gives the phase, and its magnitude is set to that of the fit. Only
// a phase is told from held-out data: an amplitude told there would remove
// anything periodic.
GapCandidate HeldOut::InPhase(const GapCandidate& effect, int log,
                              const MatrixXd& residual, GapData* data) const {
  GapCandidate one = effect;
  one.log = log;
  Eigen::Vector2d both(effect.p[effect.linear[0]], effect.p[effect.linear[1]]);
  const double size = both.norm();
  JointRows unit[2];
  for (int k = 0; k < 2; ++k) {
    one.p[effect.linear[k]] = 1;
    one.p[effect.linear[1 - k]] = 0;
    unit[k] = EffectTorque(fit_.baseline(), fit_.scale(), {one}, data);
  }
  Eigen::Matrix2d G = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
  for (int j = 0; j < residual.cols(); ++j) {
    if (unit[0][j].size() == 0 || unit[1][j].size() == 0) continue;
    for (int a = 0; a < 2; ++a) {
      g[a] += unit[a][j].dot(residual.col(j));
      for (int b = 0; b < 2; ++b) G(a, b) += unit[a][j].dot(unit[b][j]);
    }
  }
  const Eigen::Vector2d best = G.ldlt().solve(g);
  if (best.allFinite() && best.norm() > 0) both = size * best.normalized();
  for (int k = 0; k < 2; ++k) one.p[effect.linear[k]] = both[k];
  return one;
}

// The residual in units of its own standard deviation at each sample, extra
// variance included; NaN where the joint has no rows, so that standstill is in
// no mean.
MatrixXd HeldOut::Deviations(const MatrixXd& residual) const {
  MatrixXd deviations = residual;
  for (int j = 0; j < deviations.cols(); ++j) {
    std::vector<bool> moves(deviations.rows(), false);
    for (const int k : rows().SampleOfRow(j)) moves[k] = true;
    for (int k = 0; k < deviations.rows(); ++k) {
      deviations(k, j) = moves[k]
                             ? residual(k, j) / std::sqrt(rows().variance(j, k))
                             : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return deviations;
}

HeldOut::Residuals HeldOut::AllResiduals() const {
  Residuals all;
  all.nominal = FromParts(
      [&](const Part& part) { return Residual(part, {}, fit_.before()); });
  all.refit = FromParts([&](const Part& part) {
    return Residual(part, {}, part.predictor->model_refit());
  });
  all.after = After();
  return all;
}

const MatrixXd& HeldOut::After() const {
  if (after_.size() == 0) {
    after_ = FromParts([&](const Part& part) {
      return Residual(part, part.predictor->refined().effects,
                      part.predictor->model_after());
    });
  }
  return after_;
}

HeldOutSquares HeldOut::SquaresOf(const Residuals& residuals) const {
  return {Deviations(residuals.nominal).cwiseAbs2(),
          Deviations(residuals.refit).cwiseAbs2(),
          Deviations(residuals.after).cwiseAbs2()};
}

MatrixXd HeldOut::RmsOf(const Residuals& residuals) const {
  const auto square = [](double left) {
    return std::abs(left) < kUnbounded
               ? left * left
               : std::numeric_limits<double>::infinity();
  };
  std::vector<MatrixXd> torques;
  for (const GapSegment& segment : segments()) torques.push_back(segment.tau);
  const MatrixXd recorded = rows().ThinAll(torques);
  MatrixXd rms(residuals.refit.cols(), 5);
  const std::vector<bool> masked = rows_->Masked();
  for (int j = 0; j < rms.rows(); ++j) {
    Eigen::RowVectorXd squares = Eigen::RowVectorXd::Zero(5);
    int count = 0;
    for (const int k : rows().SampleOfRow(j)) {
      if (masked[k]) continue;
      ++count;
      squares += Eigen::Matrix<double, 1, 5>{
          square(residuals.nominal(k, j)), square(residuals.refit(k, j)),
          square(residuals.after(k, j)), rows().variance(j, k),
          square(recorded(k, j))};
    }
    rms.row(j) = (squares / count).cwiseSqrt();
  }
  return rms;
}

JointRows HeldOut::Whitened(const Part& part, const MatrixXd& residual) {
  JointRows white(residual.cols());
  for (int j = 0; j < residual.cols(); ++j) {
    white[j] = part.data->rows().Whiten(j, residual.col(j));
  }
  return white;
}

const PredictedChi2& HeldOut::Chi2Of(const Part& part) {
  if (!part.chi2) {
    part.chi2 = std::make_unique<PredictedChi2>(
        part.data->WhitenedColumns(),
        part.predictor->regression().screen().BaselineInformation());
  }
  return *part.chi2;
}

// The model is fitted with the others alone, so that it may do what it can.
EffectGain HeldOut::GainOf(size_t k) const {
  const MatrixXd left = FromParts([&](const Part& part) {
    const std::vector<GapCandidate> others =
        AllBut(part.predictor->refined().effects, k);
    return Residual(part, others, part.predictor->ModelGiven(others));
  });
  return GainBetween(Deviations(left), Deviations(After()), seed_);
}

// Chi squared that the effect should change and does, with what models lack as
// a rule fitted too, under the posterior's uncertainty. What data that lack a
// part would not have chosen is not confirmed by that part.
std::vector<Confirmation> HeldOut::ConfirmationsOf(
    size_t k, const std::vector<PlacedEffect>& alike) const {
  std::vector<Confirmation> confirmed(parts_.size());
  tbb::parallel_for(size_t{0}, parts_.size(), [&](size_t p) {
    const Part& part = parts_[p];
    const Predictor& model = *part.predictor;
    const std::vector<GapCandidate> others = AllBut(model.refined().effects, k);
    const auto whitened = [&](const std::vector<GapCandidate>& effects,
                              const VectorXd& baseline) {
      return Whitened(part, Residual(part, effects, baseline));
    };
    confirmed[p] =
        Confirm(Chi2Of(part), whitened(others, model.BaselineGiven(others)),
                whitened(model.refined().effects, model.refined().baseline));
    if (!model.ChoseOneOf(alike)) {
      confirmed[p].explained = std::min(0., confirmed[p].explained);
    }
  });
  return confirmed;
}

}  // namespace armcal
