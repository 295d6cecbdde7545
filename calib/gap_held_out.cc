#include "calib/gap_held_out.h"

#include <cmath>
#include <limits>

#include "calib/gap_search.h"

namespace armcal {

using Eigen::MatrixXd;
using Eigen::VectorXd;

HeldOut::HeldOut(const GapFit& fit, std::vector<GapSegment> segments,
                 LogPart part, bool other_logs)
    : fit_(fit),
      other_logs_(other_logs),
      data_(std::make_unique<GapData>(std::move(segments), fit.baseline(),
                                      fit.rows().bandwidth_hz(), part)) {
  data_->SetNoise(fit.noise().joints);
  if (fit.events().empty()) return;
  if (other_logs) {
    MaskEvents();
  } else {
    for (const GapEvent& event : fit.events()) {
      data_->Mask(event.contact.log, event.contact.window);
    }
  }
  data_->SetNoise(fit.noise().joints);
}

// An arm that was touched in one log may have been in another: windows that
// stand out from what the fitted effects leave are not judged by.
void HeldOut::MaskEvents() {
  constexpr int kMostWindows = 12;
  constexpr double kReal = 100;                      // chi^2
  const std::vector<double> durations = {.4, 1, 2};  // s
  const MatrixXd residual =
      Residual(fit_.refined().effects, fit_.refined().baseline);
  for (int round = 0; round < kMostWindows; ++round) {
    const MatrixXd left = Deviations(residual).unaryExpr(
        [](double x) { return std::isnan(x) ? 0 : x; });
    double most = kReal;
    int log = -1;
    TimeWindow worst{0, 0};
    for (size_t i = 0; i < segments().size(); ++i) {
      const int s = static_cast<int>(i), begin = rows().thin_begin(s);
      const int size = rows().thin_begin(s + 1) - begin;
      VectorXd t(size);
      for (int k = 0; k < size; ++k) t[k] = rows().thin_time(s, begin + k);
      int searched = 0;
      for (const TimeWindow& window : StrongWindows(
               left.middleRows(begin, size), t, durations, 1, &searched)) {
        if (window.strength <= most) continue;
        most = window.strength;
        worst = window;
        log = segments()[i].log;
      }
    }
    if (log < 0) return;
    const TimeRange range{worst.centre - worst.duration,
                          worst.centre + worst.duration};
    data_->Mask(log, range);
    data_->SetNoise(fit_.noise().joints);
  }
}

MatrixXd HeldOut::Residual(const std::vector<GapCandidate>& effects,
                           const VectorXd& baseline) const {
  return data_->ResidualWith(
      baseline, EffectTorque(fit_.baseline(), fit_.scale(), effects,
                             other_logs_, data_.get()));
}

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

MatrixXd HeldOut::Squares(const std::vector<GapCandidate>& effects,
                          const VectorXd& baseline) const {
  return Deviations(Residual(effects, baseline)).cwiseAbs2();
}

HeldOutSquares HeldOut::AllSquares() const {
  HeldOutSquares squares;
  squares.nominal = Squares({}, fit_.before());
  squares.refit = Squares({}, fit_.refit());
  squares.after = Squares(fit_.refined().effects, fit_.refined().baseline);
  return squares;
}

double HeldOut::Gain(size_t k, double after) const {
  std::vector<GapCandidate> others = fit_.refined().effects;
  others.erase(others.begin() + k);
  return MeanSquare(Squares(others, fit_.BaselineWithout(k))) - after;
}

}  // namespace armcal
