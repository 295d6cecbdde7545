#include "calib/drive_gains/estimate_drive_gains.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "calib/drive_gains/covariance.h"
#include "calib/drive_gains/current_pass.h"
#include "calib/drive_gains/fit.h"
#include "calib/drive_gains/reasons.h"
#include "calib/linear/calibration_checks.h"
#include "calib/linear/calibration_model.h"
#include "calib/linear/transition_search.h"
#include "model/signals/bandwidth.h"
#include "problems/make_rows.h"

namespace armcal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// 1 / K is this many standard deviations clear of 0, or K counts as unknown.
constexpr double kClearDeviations = 3;

// What the inertial parameters of a body on the last link add to the model
// parameters, which are linear in them: m x 10.
MatrixXd PayloadColumns(const ModelParameters& parameters, Robot robot) {
  for (Link& link : robot.links) {
    link.inertial = InertialParameters();
    link.joint.viscous = link.joint.coulomb = 0;
    link.joint.offset = link.joint.armature = 0;
  }
  MatrixXd B(parameters.size(), 10);
  for (int k = 0; k < 10; ++k) {
    robot.links.back().inertial =
        InertialParameters::FromVector(Vector10d::Unit(k));
    B.col(k) = parameters.Values(robot);
  }
  return B;
}

// Before anything is known.
DriveGains Unknown(const Robot& robot, double payload_mass) {
  const double infinite = std::numeric_limits<double>::infinity();
  DriveGains result;
  for (const Link& link : robot.links) {
    result.gains.push_back({link.joint.name,
                            std::string(EffortUnit(link.joint.type)) + "/A",
                            std::nan(""), infinite, false, ""});
  }
  result.covariance = MatrixXd::Zero(robot.num_joints(), robot.num_joints());
  result.payload_mass = payload_mass;
  result.com.assign(3, {std::nan(""), infinite, false});
  return result;
}

// Gradients by (g, x, p) of what is reported: each joint's 1 / K, then the
// payload's mass (times the common scale) and centre of mass p_k / p_0.
MatrixXd Gradients(const GainFit& fit, double payload_mass) {
  const int n = static_cast<int>(fit.noise.size());
  const VectorXd& p = fit.estimate.p;
  const Index mass = n + fit.estimate.x.size();
  MatrixXd D = MatrixXd::Zero(mass + 10, n + 4);
  for (int j = 0; j < n; ++j) {
    D.col(j) = MassTimesInverseGainGradient(fit, j) / payload_mass;
  }
  D(mass, n) = 1;
  for (int k = 1; k <= 3; ++k) {
    if (p[0] == 0) continue;
    D(mass, n + k) = -p[k] / (p[0] * p[0]);
    D(mass + k, n + k) = 1 / p[0];
  }
  return D;
}

// `covariance`: of the quantities of Gradients().
void ReportGains(const GainFit& fit, const GainSensitivity& sensitivity,
                 const MatrixXd& D, const MatrixXd& covariance,
                 bool has_payload, DriveGains* result) {
  const int n = static_cast<int>(fit.noise.size());
  GainReasons reasons(sensitivity, has_payload);
  VectorXd slope = VectorXd::Zero(n);  // dK / d(1/K)
  for (int j = 0; j < n; ++j) {
    DriveGain& out = result->gains[j];
    const double inverse =
        MassTimesInverseGain(fit.estimate, j) / result->payload_mass;
    const double stddev = std::sqrt(covariance(j, j));
    out.identifiable = fit.noise[j] > 0 && sensitivity.Sees(D.col(j)) &&
                       std::abs(inverse) > kClearDeviations * stddev;
    reasons.Add(fit.noise[j] > 0, D.col(j), out.identifiable);
    if (!out.identifiable) continue;
    slope[j] = -1 / (inverse * inverse);
    out.value = 1 / inverse;
    out.stddev = stddev * -slope[j];
  }
  for (int j = 0; j < n; ++j) result->gains[j].reason = reasons.Text(j);
  result->covariance =
      slope.asDiagonal() * covariance.topLeftCorner(n, n) * slope.asDiagonal();
}

void ReportCentre(const GainFit& fit, const GainSensitivity& sensitivity,
                  const MatrixXd& D, const MatrixXd& covariance,
                  DriveGains* result) {
  const Index mass = fit.noise.size();
  const VectorXd& p = fit.estimate.p;
  if (!(std::abs(p[0]) > kClearDeviations * std::sqrt(covariance(mass, mass))))
    return;
  for (int k = 1; k <= 3; ++k) {
    if (!sensitivity.Sees(D.col(mass + k))) continue;
    result->com[k - 1] = {p[k] / p[0],
                          std::sqrt(covariance(mass + k, mass + k)), true};
  }
}

DriveGains Estimate(const Robot& robot, const LinearCalibrationOptions& options,
                    const RowOptions& rows, double payload_mass,
                    const ModelParameters& parameters, const PreparedLogs& bare,
                    const PreparedLogs* payload) {
  DriveGains result = Unknown(robot, payload_mass);
  CurrentPass pass(parameters, rows, PayloadColumns(parameters, robot),
                   options.progress, bare, payload);
  const RobustLoss loss = options.loss.value_or(RobustLoss::kHuber);
  const GainFit fit = FitGains(parameters.Values(robot), loss, &pass);
  result.noise = fit.noise;
  result.outliers = fit.outliers;
  result.equations = fit.equations;
  result.bandwidth_hz = rows.bandwidth_hz;
  result.reason = fit.failure;
  if (fit.failure.empty()) {
    const GainSensitivity sensitivity(WhitenedEquations(fit.factors, fit.noise),
                                      pass.B(), fit.estimate, fit.reference);
    const MatrixXd D = Gradients(fit, payload_mass);
    const CovarianceEstimate covariance =
        EstimateGainCovariance(fit, loss, D, rows.hops, &pass);
    ReportGains(fit, sensitivity, D, covariance.covariance, pass.has_payload(),
                &result);
    ReportCentre(fit, sensitivity, D, covariance.covariance, &result);
    result.covariance_method = covariance.method;
    result.reason = GainVerdict(result.gains);
  }
  result.passes = pass.passes() + 1;  // the audit
  result.solved = result.reason.empty();
  if (result.solved) result.reason = "solved";
  return result;
}

}  // namespace

std::vector<double> DriveGains::TorqueConstants() const {
  CHECK(solved);
  std::vector<double> constants;
  for (const DriveGain& gain : gains) constants.push_back(gain.value);
  return constants;
}

int DriveGains::LeastCertain() const {
  CHECK(solved);
  const auto relative = [](const DriveGain& gain) {
    return gain.stddev / std::abs(gain.value);
  };
  const auto least = std::max_element(
      gains.begin(), gains.end(), [&](const DriveGain& a, const DriveGain& b) {
        return relative(a) < relative(b);
      });
  return static_cast<int>(least - gains.begin());
}

double DriveGains::LargestRelativeStddev() const {
  const DriveGain& gain = gains[LeastCertain()];
  return gain.stddev / std::abs(gain.value);
}

DriveGains EstimateDriveGains(const Robot& robot,
                              const LinearCalibrationOptions& options,
                              double payload_mass, const LogSet& bare,
                              const LogSet* payload) {
  CHECK_GT(payload_mass, 0);
  LinearCalibrationOptions weak = options;
  weak.identification = Identification::kWeak;
  weak.geometry = GeometryKnowledge::kKnown;
  Robot arm = robot;
  // A payload need not be as symmetric as the arm.
  for (Link& link : arm.links) link.zero_inertials.clear();
  std::vector<TimeBase> time_bases = bare.time_bases();
  CheckBandwidth(options.bandwidth_hz, bare);
  if (payload != nullptr) {
    CheckBandwidth(options.bandwidth_hz, *payload);
    time_bases.insert(time_bases.end(), payload->time_bases().begin(),
                      payload->time_bases().end());
  }
  if (!weak.bandwidth_hz) weak.bandwidth_hz = DefaultBandwidth(time_bases);
  const RowOptions rows = MakeRowOptions(weak, bare);
  const PreparedLogs unloaded = Prepare(bare, PreparationForRows(rows));
  std::optional<PreparedLogs> loaded;
  if (payload != nullptr) loaded = Prepare(*payload, PreparationForRows(rows));
  const Transitions transitions =
      FindTransitions(arm, weak, rows, unloaded, TorqueUnits::kPerJoint);
  DriveGains result = Estimate(arm, weak, rows, payload_mass,
                               MakeParameters(arm, weak, transitions), unloaded,
                               loaded ? &*loaded : nullptr);
  if (!transitions.empty() && !weak.transition) result.passes += 2;
  return result;
}

}  // namespace armcal
