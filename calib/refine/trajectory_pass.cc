#include "calib/refine/trajectory_pass.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/numerics/robust_rows.h"
#include "problems/robust_loss.h"

namespace armcal {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Standard deviation of what is believed of a fitted width's logarithm beyond
// the data, which may not see it at all.
constexpr double kLogWidthPrior = 1;
constexpr double kLeastNoise = 1e-12;        // rad or m, N m or N
constexpr double kHuberMeanSquare = 0.7102;  // of psi, for normal errors

TrajectoryNoise NoiseOf(const TrajectoryEstimate& estimate, int log) {
  TrajectoryNoise noise = estimate.noise;
  for (Eigen::Index j = 0; j < noise.torque.size(); ++j) {
    if (estimate.used[log][j]) continue;
    noise.torque[j] = std::numeric_limits<double>::infinity();
  }
  return noise;
}

// The noise over what it was taken for, by sum psi^2 / (E psi^2 degrees).
// `spent` is the share of degrees of freedom that the parameters took, `fitted`
// what the splines took.
ArrayXd NoiseFactor(const NoiseSums& sums, double spent, double mean_square) {
  const ArrayXd degrees =
      ((1 - spent) * (sums.count - sums.fitted)).max(0.05 * sums.count).max(1);
  return (sums.squares / (mean_square * degrees)).sqrt().max(1e-6);
}

}  // namespace

void TrajectoryPass::ForEach(const std::string& stage,
                             const ModelParameters& parameters,
                             const Visit& visit) {
  std::vector<TrajectoryCorrection> corrections(
      logs_.size(), TrajectoryCorrection(parameters, knot_s_));
  logs_.ForEach(stage, progress_, [&](int log, const Trajectory& t) {
    if (corrections[log].Enter(t)) visit(log, &corrections[log]);
  });
  ++passes_;
}

// Sums the border's normal equations over all stretches, each with its spline
// fitted at the present x. Widths that the data do not see would make them
// singular; a prior of one on their logarithm keeps them where they are.
TrajectoryEquations TrajectoryPass::Gather(const std::string& stage,
                                           const TrajectoryEstimate& estimate,
                                           TorqueWeighting weighting,
                                           const Visit& visit) {
  constexpr int kSteps = 3;  // of the splines
  TrajectoryEquations sum(estimate.parameters.num_joints());
  ForEach(stage, estimate.parameters,
          [&](int log, TrajectoryCorrection* stretch) {
            const int border = stretch->border();
            if (sum.gradient.size() == 0) {
              sum.information.setZero(border, border);
              sum.gradient.setZero(border);
            }
            if (!stretch->Fit(estimate.x, NoiseOf(estimate, log), weighting,
                              kSteps) ||
                !stretch->Eliminate(&sum.information, &sum.gradient,
                                    &sum.encoder, &sum.torque)) {
              sum.failed = true;
              return;
            }
            if (visit) visit(log, stretch);
          });
  sum.failed |= sum.gradient.size() == 0;
  if (sum.failed) return sum;
  // Without the widths where they are given.
  const int size = estimate.size();
  sum.information = sum.information.topLeftCorner(size, size).eval();
  sum.gradient = sum.gradient.head(size).eval();
  constexpr double kPrior = 1 / (kLogWidthPrior * kLogWidthPrior);
  const Eigen::Index widths = estimate.log_width.size();
  sum.information.diagonal().tail(widths).array() += kPrior;
  sum.gradient.tail(widths) -= kPrior * estimate.log_width;
  return sum;
}

// The encoders' noise from what splines leave of N positions with p control
// points, sum e^2 / (N - p); the torques' from the median of what x leaves at
// these splines, since Huber's loss needs a scale that outliers did not make.
TrajectoryNoise GuessTrajectoryNoise(const TrajectoryEstimate& estimate,
                                     TrajectoryPass* pass) {
  const int n = estimate.parameters.num_joints();
  TrajectoryNoise unit;
  unit.encoder = unit.torque = ArrayXd::Ones(n);
  ArrayXd squares = ArrayXd::Zero(n);
  double degrees = 0;
  std::vector<ResidualStatistics> torque(n);
  pass->ForEach(
      "noise", estimate.parameters, [&](int, TrajectoryCorrection* stretch) {
        const MatrixXd e = stretch->PositionErrors();
        squares += e.colwise().squaredNorm().transpose().array();
        degrees += static_cast<double>(e.rows() - stretch->num_points());
        stretch->Fit(estimate.x, unit, TorqueWeighting::kSquared, 0);
        for (int j = 0; j < n; ++j) {
          for (const double r : stretch->torque_residuals().col(j)) {
            torque[j].Add(r);
          }
        }
      });
  TrajectoryNoise noise = unit;
  noise.encoder = (squares / std::max(1.0, degrees)).sqrt().max(kLeastNoise);
  for (int j = 0; j < n; ++j) {
    noise.torque[j] = std::max(kLeastNoise, torque[j].RobustSpread());
  }
  noise.mean_slope = noise.mean_square = ArrayXd::Ones(n);
  return noise;
}

// Scales sigma so that sum psi(z)^2 = E psi^2 degrees: Huber's second proposal
// (Huber 1964, Annals of Mathematical Statistics 35). As psi of outliers does
// not grow when sigma shrinks, the plain ratio falls short; near the solution
// Newton's step in log sigma makes up for it.
double UpdateTrajectoryNoise(const TrajectoryEquations& equations, bool huber,
                             TrajectoryEstimate* estimate) {
  const NoiseSums& sums = equations.torque;
  const double spent =
      std::min(0.9, estimate->size() / std::max(1.0, sums.count.sum()));
  const ArrayXd encoder = NoiseFactor(equations.encoder, 0, 1);
  ArrayXd torque = NoiseFactor(sums, spent, huber ? kHuberMeanSquare : 1);
  for (int j = 0; j < torque.size(); ++j) {
    if (estimate->frozen[j] || sums.count[j] == 0) torque[j] = 1;
    if (!huber || sums.squares[j] == 0) continue;
    // Newton's step: of psi's squares only those inside grow with the errors.
    const double outside = std::pow(LossScale(RobustLoss::kHuber), 2) *
                           (sums.count[j] - sums.slope[j]) / sums.squares[j];
    if (std::abs(std::log(torque[j])) > 0.3) continue;
    torque[j] = std::pow(torque[j], 1 / std::max(0.4, 1 - outside));
  }
  TrajectoryNoise& noise = estimate->noise;
  noise.encoder = (noise.encoder * encoder).max(kLeastNoise);
  noise.torque = (noise.torque * torque).max(kLeastNoise);
  if (huber) {
    noise.mean_slope = sums.slope / sums.count.max(1);
    noise.mean_square =
        sums.squares / ((1 - spent) * (sums.count - sums.fitted)).max(1);
    // A joint without samples.
    noise.mean_slope = (sums.count > 0).select(noise.mean_slope, 1);
    noise.mean_square = (sums.count > 0).select(noise.mean_square, 1);
  }
  return std::max(encoder.log().abs().maxCoeff(),
                  torque.log().abs().maxCoeff());
}

}  // namespace armcal
