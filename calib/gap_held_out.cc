#include "calib/gap_held_out.h"

#include <cmath>
#include <limits>

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
  if (other_logs) return;
  for (const GapEvent& event : fit.events()) {
    data_->Mask(event.effect.log, event.window);
  }
  data_->SetNoise(fit.noise().joints);
}

MatrixXd HeldOut::Squares(const std::vector<GapCandidate>& effects,
                          const VectorXd& baseline) const {
  MatrixXd squares = data_->ResidualWith(baseline);
  if (!effects.empty()) {
    squares -= EffectTorque(fit_.baseline(), fit_.scale(), effects, other_logs_,
                            data_.get());
  }
  for (int j = 0; j < squares.cols(); ++j) {
    std::vector<bool> moves(squares.rows(), false);
    for (const int k : rows().SampleOfRow(j)) moves[k] = true;
    for (int k = 0; k < squares.rows(); ++k) {
      squares(k, j) =
          moves[k] ? squares(k, j) * squares(k, j) / rows().variance(j, k)
                   : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return squares;
}

HeldOutSquares HeldOut::AllSquares() const {
  HeldOutSquares squares;
  squares.nominal = Squares({}, VectorXd::Zero(fit_.baseline().size()));
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
