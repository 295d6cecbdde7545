#include "calib/poses/calibrate_poses.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "calib/numerics/median.h"
#include "calib/poses/coupling.h"
#include "calib/poses/fit.h"
#include "calib/poses/follow.h"
#include "calib/poses/held_out_figures.h"
#include "calib/poses/misfit.h"
#include "calib/poses/outliers.h"
#include "calib/poses/pose_solution.h"
#include "calib/poses/seen_unknowns.h"
#include "calib/poses/shared_errors.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Derivatives by the free parameters, then by what else there is, with the
// priors of the latter, of those by all.
MatrixXd FreeJacobian(const PoseFit& fit, const std::vector<bool>& free,
                      const MatrixXd& by_all) {
  const MatrixXd J = fit.WithOtherPriors(by_all);
  std::vector<int> columns;
  for (int k = 0; k < J.cols(); ++k) {
    if (k >= fit.geometry().size() || free[k]) columns.push_back(k);
  }
  return J(Eigen::all, columns);
}

void ReportInstrument(const InstrumentUnknowns& unknowns, const VectorXd& at,
                      const MatrixXd& covariance, PoseCalibration* result) {
  if (unknowns.size() == 0) return;
  const VectorXd value = unknowns.start + unknowns.by_unknowns * at;
  const MatrixXd spread =
      unknowns.by_unknowns * covariance * unknowns.by_unknowns.transpose();
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    result->instrument.push_back({unknowns.names[k], unknowns.units[k],
                                  unknowns.start[k], value[k],
                                  std::sqrt(spread(k, k))});
  }
}

// An instrument's own unknowns are told as what they stand for instead.
void ReportObserved(const PoseFit& fit, const PoseUnknowns& at,
                    const VectorXd& variance, const VectorXd& unseen,
                    PoseCalibration* result) {
  if (fit.measured().poses.size() > 0) return;
  const std::vector<std::string> names =
      PoseUnknowns::OtherNames(fit.measured());
  for (Eigen::Index k = 0; k < at.other.size(); ++k) {
    // A plane is two slopes and a distance.
    const bool is_slope = fit.measured().planes && k % 3 < 2;
    const bool is_seen = unseen[k] < 1e-6 && std::isfinite(variance[k]);
    result->observed.push_back({names[k], is_slope ? "1" : "m", at.other[k],
                                is_seen
                                    ? std::sqrt(variance[k])
                                    : std::numeric_limits<double>::infinity()});
  }
}

// The free parameters with standard deviations from the data alone.
void ReportParameters(const PoseFit& fit, const std::vector<bool>& free,
                      const std::vector<int>& rows, const PoseUnknowns& at,
                      PoseCalibration* result) {
  const ArmGeometry& geometry = fit.geometry();
  const std::vector<std::string> names = geometry.Names();
  const std::vector<std::string> units = geometry.Units();
  const VectorXd nominal = geometry.Values();
  VectorXd residuals;
  const MatrixXd by_all = fit.Jacobian(rows, at, &residuals);
  const MatrixXd J = FreeJacobian(fit, free, by_all);
  const SeenUnknowns seen(J);
  const MatrixXd covariance =
      seen.half *
      PoseScoreCovariance(fit, rows, by_all, residuals, J * seen.half) *
      seen.half.transpose();
  Eigen::Index c = 0;
  for (int p = 0; p < geometry.size(); ++p) {
    if (!free[p]) continue;
    // The loss of a hopeless fit may be all slope: no variance then.
    const bool is_seen =
        seen.unseen[c] < 1e-6 && std::isfinite(covariance(c, c));
    result->parameters.push_back(
        {names[p], units[p], nominal[p], at.geometry[p],
         is_seen ? std::sqrt(covariance(c, c))
                 : std::numeric_limits<double>::infinity(),
         fit.PriorOf(p), is_seen});
    ++c;
  }
  const Eigen::Index others = at.other.size();
  ReportObserved(fit, at, covariance.diagonal().tail(others),
                 seen.unseen.tail(others), result);
  ReportInstrument(fit.measured().instrument, at.other,
                   covariance.bottomRightCorner(others, others), result);
}

// What is left of all poses, of the inliers, which it returns, and of these
// beside the instrument.
std::vector<int> ReportErrors(const PoseFit& fit,
                              const PoseMeasurements& measured,
                              const PoseSolution& solution,
                              PoseCalibration* result) {
  const PoseUnknowns& at = solution.unknowns;
  const std::vector<int> rows = fit.AllRows();
  result->after = fit.Distances(rows, at);
  result->rms = Rms(result->after);
  result->median = Median(result->after);
  result->max = *std::max_element(result->after.begin(), result->after.end());
  result->outliers = FindOutliers(fit, at, rows);
  std::vector<int> inliers;
  std::set_difference(rows.begin(), rows.end(), result->outliers.begin(),
                      result->outliers.end(), std::back_inserter(inliers));
  if (!inliers.empty()) result->inlier_rms = Rms(fit.Distances(inliers, at));
  result->inlier_motion = MotionShare(measured.q, inliers);
  result->misfit =
      MeasureMisfit(fit, measured, at, inliers, fit.NumUnknowns(solution.free));
  return inliers;
}

}  // namespace

// One fit, and then the questions to it: how large errors are in and out of it,
// which poses it gives up, whether a relation between joints explains more, how
// sure it is.
PoseCalibration CalibratePoses(const Robot& robot,
                               const PoseMeasurements& measured,
                               const PoseCalibrationOptions& options) {
  PoseFit fit(robot, measured, options);
  PoseCalibration result;
  result.robot = robot;
  result.count = measured.size();
  if (measured.tilts.size() > 0) result.unit = "rad";
  result.loss = options.loss;
  result.refined = options.refine != RefineGeometry::kNothing;
  result.travel =
      measured.q.colwise().maxCoeff() - measured.q.colwise().minCoeff();
  result.extent = PoseExtent(measured);
  const PoseSolution solution = SolvePoses(measured, options.refine, &fit);
  result.reason = solution.refusal;
  result.before = solution.before;
  result.before_rms = solution.before.empty() ? 0 : Rms(solution.before);
  result.held = solution.held;
  if (!result.reason.empty()) return result;
  result.solved = true;
  result.reason = "solved";
  result.noise = fit.TypicalNoise();
  const std::vector<int> inliers =
      ReportErrors(fit, measured, solution, &result);
  result.coupling = FindCoupling(robot, measured, options);
  ReportHeldOut(fit, solution, options, &result);
  // What Tukey's loss gives up tells nothing; the others let all poses pull.
  const bool some = options.loss == RobustLoss::kTukey && !inliers.empty();
  ReportParameters(fit, solution.free, some ? inliers : fit.AllRows(),
                   solution.unknowns, &result);
  ArmGeometry refined = fit.geometry();
  refined.SetValues(solution.unknowns.geometry);
  result.robot = refined.ApplyTo(robot);
  // An instrument's frame stands as it was set up, and says nothing of the
  // vertical: the arm stands as in its file. An inclinometer's is the vertical.
  if (measured.tilts.size() == 0) result.robot.gravity = robot.gravity;
  return result;
}

}  // namespace armcal
