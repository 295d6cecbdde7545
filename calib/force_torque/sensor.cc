#include "calib/force_torque/sensor.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>

#include "calib/force_torque/start.h"
#include "calib/numerics/block_bootstrap.h"
#include "model/text/format.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;

constexpr int kFewestDirections = 2;

// The rotation R that brings |s R - M| to its least in the directions that are
// told (Procrustes; Kabsch 1976): U diag(1, 1, det(U V')) V' of the singular
// values of s M. A direction that is not told follows from the other two. Not
// NearestRotation(), which takes -M for a reflection: the sign is s here.
Matrix3d RotationOf(const Matrix3d& M, double sign) {
  const Eigen::JacobiSVD<Matrix3d> svd(
      sign * M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d V = svd.matrixV();
  V.col(2) *= (svd.matrixU() * V.transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * V.transpose();
}

// Nothing where no load of a positive mass fits.
std::optional<ForceTorqueFit> FitWithSign(const ForceTorqueStart& start,
                                          double sign,
                                          const ForceTorqueSamples& samples) {
  ForceTorqueModel model;
  model.sign = sign;
  model.mass = start.mass;
  model.R_LS = RotationOf(start.M, sign).transpose();
  ForceTorqueFit fit = FitForceTorque(model, samples);
  if (!(fit.model.mass > 0) || !fit.covariance.allFinite()) return {};
  return fit;
}

// By which factor a log likelihood ratio is too large, as samples follow each
// other: the largest autocorrelation time of what is left.
double WorstTime(const ForceTorqueFit& fit, const ForceTorqueSamples& samples) {
  double worst = 1;
  std::vector<double> left(samples.size());
  for (int c = 0; c < 6; ++c) {
    for (size_t k = 0; k < samples.size(); ++k) {
      left[k] = samples[k].wrench[c] - fit.model.Predict(samples[k].motion)[c];
    }
    worst = std::max(worst, CorrelationTime(left));
  }
  return worst;
}

// The likelier of both fits; says where they are nearly as likely.
void Choose(const std::optional<ForceTorqueFit>& on,
            const std::optional<ForceTorqueFit>& of,
            const ForceTorqueSamples& samples, ForceTorqueSensor* sensor) {
  constexpr double kSure = 9;  // twice the log likelihood ratio
  if (!on && !of) {
    sensor->not_told.push_back(
        "anything: no load of a positive mass fits the six channels");
    return;
  }
  sensor->solved = true;
  sensor->fit = !of || (on && on->cost <= of->cost) ? *on : *of;
  if (!on || !of) return;
  const double ratio =
      std::abs(on->cost - of->cost) / WorstTime(sensor->fit, samples);
  if (ratio >= kSure) return;
  sensor->fit = *on;
  sensor->not_told.push_back(
      "whether the sensor reports the force on its load, as assumed here, or "
      "the force of it: the motion turns the load in one plane, where a sensor "
      "mounted the other way round reads the same; the rotation and the bias "
      "differ between the two");
}

// An entry is told where its variance is less than half of the prior's: as if
// samples told as much as the prior.
void JudgeInertia(ForceTorqueSensor* sensor) {
  static constexpr const char* kNames[6] = {"Ixx", "Ixy", "Iyy",
                                            "Ixz", "Iyz", "Izz"};
  const double prior = InertiaPrior(sensor->fit.model.mass);
  std::string unknown;
  for (int k = 0; k < 6; ++k) {
    const double stddev = sensor->Stddev(ForceTorqueModel::kInertia + k);
    sensor->inertia_told[k] = stddev < std::sqrt(.5) * prior;
    if (sensor->inertia_told[k]) continue;
    unknown += (unknown.empty() ? "" : ", ") + std::string(kNames[k]);
  }
  if (unknown.empty()) return;
  sensor->not_told.push_back("of the inertia " + unknown +
                             ": the motion turns the load too slowly");
}

}  // namespace

bool CarriesForceTorque(const Robot& robot) {
  return !robot.branches() &&
         std::all_of(
             robot.links.begin(), robot.links.end(),
             [](const Link& link) { return link.unknown_lengths.empty(); });
}

ForceTorqueSensor EstimateForceTorqueSensor(const ForceTorqueSamples& samples) {
  ForceTorqueSensor sensor;
  sensor.samples = static_cast<long>(samples.size());
  if (samples.empty()) return sensor;
  const ForceTorqueStart start = StartForceTorque(samples);
  sensor.directions = start.directions;
  if (start.directions < kFewestDirections) {
    sensor.not_told.push_back(Format(
        "mass, centre of mass, rotation and bias: in the sensor's axes the "
        "force on the load is seen to change in %d of 3 directions, expected "
        "at least 2; in one orientation a weight cannot be told from a bias, "
        "so turn the last link to others",
        start.directions));
    return sensor;
  }
  Choose(FitWithSign(start, 1, samples), FitWithSign(start, -1, samples),
         samples, &sensor);
  if (sensor.solved) JudgeInertia(&sensor);
  return sensor;
}

ForceTorqueSensor EstimateForceTorqueSensor(const Robot& robot,
                                            const Progress& progress,
                                            const PreparedLogs& logs) {
  if (!logs.logs().has_wrench() || !CarriesForceTorque(robot)) return {};
  return EstimateForceTorqueSensor(GatherForceTorque(robot, progress, logs));
}

}  // namespace armcal
