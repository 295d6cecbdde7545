#include "calib/force_torque/fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "calib/linear/score_covariance.h"
#include "calib/numerics/median.h"
#include "model/robot/rotations.h"
#include "problems/robust_loss.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Unknowns = ForceTorqueModel::Unknowns;
using Information = Eigen::Matrix<double, ForceTorqueModel::kUnknowns,
                                  ForceTorqueModel::kUnknowns>;
using Residuals = Eigen::Matrix<double, Eigen::Dynamic, 6>;

// The inertial parameters' derivatives by the mass, the centre of mass and the
// inertia about it: h = m c, I_o = I + m (c'c 1 - c c').
std::vector<InertialParameters> LoadDerivatives(const ForceTorqueModel& m) {
  std::vector<InertialParameters> all;
  all.push_back(
      InertialParameters::FromCenterOfMass(1, m.center, Matrix3d::Zero()));
  for (int k = 0; k < 3; ++k) {
    const Vector3d e = Vector3d::Unit(k), &c = m.center;
    InertialParameters by_center;
    by_center.first_moment = m.mass * e;
    by_center.inertia = m.mass * (2 * c[k] * Matrix3d::Identity() -
                                  e * c.transpose() - c * e.transpose());
    all.push_back(by_center);
  }
  constexpr int kFirstInertia = 4;  // of ToVector()
  for (int k = kFirstInertia; k < 10; ++k) {
    all.push_back(InertialParameters::FromVector(Vector10d::Unit(k)));
  }
  return all;
}

Residuals Left(const ForceTorqueModel& model,
               const ForceTorqueSamples& samples) {
  Residuals left(static_cast<Eigen::Index>(samples.size()), 6);
  for (size_t k = 0; k < samples.size(); ++k) {
    left.row(static_cast<Eigen::Index>(k)) =
        (samples[k].wrench - model.Predict(samples[k].motion)).transpose();
  }
  return left;
}

// Not below what rounding of the recorded numbers makes.
Vector6d RobustNoise(const Residuals& left, const ForceTorqueSamples& samples) {
  constexpr double kNormal = 1.4826;  // standard deviations per median
  constexpr double kRounding = 1e-7;
  Vector6d size = Vector6d::Zero();
  for (const ForceTorqueSample& s : samples) {
    size = size.cwiseMax(s.wrench.cwiseAbs());
  }
  Vector6d noise;
  for (int c = 0; c < 6; ++c) {
    const Eigen::VectorXd column = left.col(c).cwiseAbs();
    noise[c] =
        kNormal * Median(std::vector<double>(column.begin(), column.end()));
  }
  return noise.cwiseMax(kRounding * size).cwiseMax(Vector6d::Constant(1e-12));
}

// By the length of all six, which one coordinate's scale is brought to.
LossAt WeighSample(RobustLoss loss, double length) {
  return EvaluateLoss(loss, length * LossScale(loss, 1) / LossScale(loss, 6));
}

Information PriorInformation(double mass) {
  Information prior = Information::Zero();
  const double deviation = InertiaPrior(mass);
  prior.diagonal()
      .segment<6>(ForceTorqueModel::kInertia)
      .setConstant(1 / (deviation * deviation));
  return prior;
}

// The entries of an inertia as unknowns have them.
Vector6d InertiaEntries(const Matrix3d& I) {
  InertialParameters about_center;
  about_center.inertia = I;
  return about_center.ToVector().tail<6>();
}

// Solves A x = b for a positive definite A whose unknowns differ in size.
Eigen::MatrixXd SolveScaled(const Information& A, const Eigen::MatrixXd& b) {
  const Unknowns scale =
      A.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Information scaled = scale.asDiagonal() * A * scale.asDiagonal();
  return scale.asDiagonal() *
         Eigen::LDLT<Information>(scaled).solve(scale.asDiagonal() * b);
}

// One Gauss-Newton step, in units of the noise.
Unknowns StepOf(const ForceTorqueModel& model, const Vector6d& noise,
                RobustLoss loss, const ForceTorqueSamples& samples) {
  Information A = PriorInformation(model.mass);
  Unknowns b = Unknowns::Zero();
  b.segment<6>(ForceTorqueModel::kInertia) =
      -A.diagonal()
           .segment<6>(ForceTorqueModel::kInertia)
           .cwiseProduct(InertiaEntries(model.inertia));
  for (const ForceTorqueSample& s : samples) {
    const Vector6d r =
        (s.wrench - model.Predict(s.motion)).cwiseQuotient(noise);
    const double weight = WeighSample(loss, r.norm()).weight;
    if (weight <= 0) continue;
    const ForceTorqueModel::Jacobian J =
        noise.cwiseInverse().asDiagonal() * model.Derivatives(s.motion);
    A.noalias() += weight * J.transpose() * J;
    b.noalias() += weight * J.transpose() * r;
  }
  constexpr double kMostTurn = .3;  // rad
  const Unknowns step = SolveScaled(A, b);
  const double turn = step.segment<3>(ForceTorqueModel::kRotation).norm();
  return turn > kMostTurn ? Unknowns(step * (kMostTurn / turn)) : step;
}

// The samples' autocorrelation from one to the next, the largest of the six
// channels'.
double LagOne(const Residuals& left, const ForceTorqueSamples& samples) {
  double most = 0;
  for (int c = 0; c < 6; ++c) {
    double product = 0, square = 0;
    for (size_t k = 1; k < samples.size(); ++k) {
      if (!samples[k].follows) continue;
      const auto row = static_cast<Eigen::Index>(k);
      product += left(row, c) * left(row - 1, c);
      square += left(row, c) * left(row, c);
    }
    if (square > 0) most = std::max(most, product / square);
  }
  return most;
}

// The sandwich H^-1 (S + P) H^-1, H = sum slope J'J + P, P the prior's.
// Windows are twice as long as Andrews' optimum, for less of a bias.
void SetCovariance(const ForceTorqueSamples& samples, RobustLoss loss,
                   ForceTorqueFit* fit) {
  constexpr int kLeastWindow = 8;  // the low pass makes four or so follow
  const ForceTorqueModel& model = fit->model;
  const Information prior = PriorInformation(model.mass);
  Residuals left =
      Left(model, samples) * fit->noise.cwiseInverse().asDiagonal();
  std::vector<Score> scores;
  scores.reserve(samples.size());
  Information A = prior;
  for (size_t k = 0; k < samples.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const Vector6d r = left.row(row).transpose();
    const LossAt at = WeighSample(loss, r.norm());
    // The mean of the loss' curvature over the six directions: psi' along the
    // residual, psi / r across it.
    const double slope = std::max(0., (at.slope + 5 * at.weight) / 6);
    const ForceTorqueModel::Jacobian J =
        fit->noise.cwiseInverse().asDiagonal() *
        model.Derivatives(samples[k].motion);
    left.row(row) *= at.weight;
    A += slope * J.transpose() * J;
    scores.push_back({at.weight * J.transpose() * r, J, slope * J});
  }
  const Eigen::MatrixXd gain = SolveScaled(A, Information::Identity());
  const auto count = static_cast<long>(samples.size());
  const int window =
      2 * BartlettWindow(LagOne(left, samples), count, kLeastWindow);
  ScoreCovariance sum(ForceTorqueModel::kUnknowns, window, gain);
  for (size_t k = 0; k < samples.size(); ++k) {
    if (!samples[k].follows) sum.Break();
    sum.Add(scores[k]);
  }
  fit->covariance = FixedShareExpansion(window, count) * gain *
                    (sum.Value() + prior) * gain.transpose();
}

}  // namespace

double InertiaPrior(double mass) {
  constexpr double kRadius = .1;  // m
  return std::max(mass, 1e-6) * kRadius * kRadius;
}

Vector6d ForceTorqueModel::Predict(const RigidMotion& motion) const {
  const RigidWrench w = WrenchOf(
      InertialParameters::FromCenterOfMass(mass, center, inertia), motion);
  Vector6d reported = bias;
  reported.head<3>() += sign * R_LS.transpose() * w.force;
  reported.tail<3>() += sign * R_LS.transpose() * w.moment;
  return reported;
}

// A turn of the sensor by d, in L's axes, makes R_LS -> (1 + [d]) R_LS, and
// R_SL w -> R_SL (w - d x w).
ForceTorqueModel::Jacobian ForceTorqueModel::Derivatives(
    const RigidMotion& motion) const {
  const Matrix3d R = sign * R_LS.transpose();
  const RigidWrench w = WrenchOf(
      InertialParameters::FromCenterOfMass(mass, center, inertia), motion);
  Jacobian J = Jacobian::Zero();
  J.block<3, 3>(0, kRotation) = R * CrossProductMatrix(w.force);
  J.block<3, 3>(3, kRotation) = R * CrossProductMatrix(w.moment);
  int column = kMass;
  for (const InertialParameters& by : LoadDerivatives(*this)) {
    const RigidWrench d = WrenchOf(by, motion);
    J.block<3, 1>(0, column) = R * d.force;
    J.block<3, 1>(3, column++) = R * d.moment;
  }
  J.block<6, 6>(0, kBias).setIdentity();
  return J;
}

ForceTorqueModel ForceTorqueModel::Moved(const Unknowns& step) const {
  ForceTorqueModel moved = *this;
  const Vector3d turn = step.segment<3>(kRotation);
  if (turn.norm() > 0) {
    moved.R_LS = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * moved.R_LS;
  }
  moved.mass += step[kMass];
  moved.center += step.segment<3>(kCenter);
  Vector10d V = Vector10d::Zero();
  V.tail<6>() = step.segment<6>(kInertia);
  moved.inertia += InertialParameters::FromVector(V).inertia;
  moved.bias += step.segment<6>(kBias);
  return moved;
}

ForceTorqueFit FitForceTorque(const ForceTorqueModel& start,
                              const ForceTorqueSamples& samples) {
  constexpr int kMostSteps = 30;
  constexpr double kSmallStep = 1e-4;  // of the noise of the estimate
  ForceTorqueFit fit;
  fit.model = start;
  for (const RobustLoss loss : {RobustLoss::kHuber, RobustLoss::kTukey}) {
    for (int k = 0; k < kMostSteps; ++k) {
      fit.noise = RobustNoise(Left(fit.model, samples), samples);
      const Unknowns step = StepOf(fit.model, fit.noise, loss, samples);
      fit.model = fit.model.Moved(step);
      const double size = (fit.model.Derivatives(samples[0].motion) * step)
                              .cwiseQuotient(fit.noise)
                              .norm();
      if (size < kSmallStep) break;
    }
  }
  const Residuals left = Left(fit.model, samples);
  fit.noise = RobustNoise(left, samples);
  fit.rms = (left.cwiseAbs2().colwise().mean()).cwiseSqrt().transpose();
  SetCovariance(samples, RobustLoss::kTukey, &fit);
  fit.cost =
      2 * static_cast<double>(samples.size()) * fit.noise.array().log().sum();
  return fit;
}

}  // namespace armcal
