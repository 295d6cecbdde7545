#include "calib/inspect/rows_fit.h"

#include <algorithm>
#include <cmath>

#include "model/dynamics/inverse_dynamics.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr size_t kSamplesOfFit = 500;
constexpr double kTanhWidth = .03;  // rad/s or m/s, as TorqueFit
constexpr double kBestShare = .01;  // of the torque: no model is better

}  // namespace

WiringSamples SamplesAt(const UniformSeries& series,
                        const std::vector<int>& samples) {
  WiringSamples at;
  at.motion.dt = series.dt();
  at.motion.q = series.motion().q(samples, Eigen::all);
  at.motion.qd = series.motion().qd(samples, Eigen::all);
  at.motion.qdd = series.motion().qdd(samples, Eigen::all);
  at.tau = series.tau()(samples, Eigen::all);
  return at;
}

RowsFit::RowsFit(const Robot& robot, const UniformSeries& series,
                 std::vector<int> samples)
    : robot_(robot) {
  const size_t all = samples.size();
  const size_t size = std::min(kSamplesOfFit, all);
  for (size_t k = 0; k < size; ++k) samples[k] = samples[k * all / size];
  samples.resize(size);
  SetFigures(SamplesAt(series, samples),
             static_cast<double>(all) / static_cast<double>(size), series.dt());
  const auto half = samples.begin() + static_cast<long>(size / 2);
  fits_ = {FitTo(series, samples), FitTo(series, {samples.begin(), half}),
           FitTo(series, {half, samples.end()})};
}

// What a fit to these samples, of `times` as many, is like.
void RowsFit::SetFigures(const WiringSamples& samples, double times,
                         double dt) {
  const TorqueFit fit(robot_, samples.motion);
  const MatrixXd ones = MatrixXd::Ones(samples.tau.rows(), samples.tau.cols());
  const VectorXd counts =
      fit.InMotion(ones).colwise().sum().transpose().cwiseMax(1);
  const MatrixXd tau = fit.InMotion(samples.tau);
  const VectorXd squares =
      tau.colwise().squaredNorm().transpose().cwiseQuotient(counts);
  left_ = fit.Squares(fit.Parameters(samples.tau), samples.tau)
              .cwiseQuotient(counts) +
          kBestShare * kBestShare * squares;
  mean_ = tau.colwise().sum().transpose().cwiseQuotient(counts);
  variance_ = squares - mean_.cwiseAbs2();
  moved_ = counts * times * dt;
}

RowsFit::FittedArm RowsFit::FitTo(const UniformSeries& series,
                                  const std::vector<int>& samples) const {
  const WiringSamples at = SamplesAt(series, samples);
  const VectorXd x = TorqueFit(robot_, at.motion).Parameters(at.tau);
  FittedArm fitted{robot_, x.tail(4 * robot_.num_joints())};
  for (int i = 0; i < robot_.num_joints(); ++i) {
    fitted.robot.links[i].inertial =
        InertialParameters::FromVector(x.segment<10>(10 * i));
  }
  return fitted;
}

VectorXd RowsFit::Torque(const FittedArm& arm, const Motion& motion, int joint,
                         bool own) {
  VectorXd torque(motion.size());
  for (int s = 0; s < motion.size(); ++s) {
    torque[s] = InverseDynamics(arm.robot, motion.q.row(s), motion.qd.row(s),
                                motion.qdd.row(s))[joint];
    if (!own) continue;
    const double qd = motion.qd(s, joint);
    torque[s] += arm.own[4 * joint] * qd +
                 arm.own[4 * joint + 1] * std::tanh(qd / kTanhWidth) +
                 arm.own[4 * joint + 2] +
                 arm.own[4 * joint + 3] * motion.qdd(s, joint);
  }
  return torque;
}

// Fits to two halves of the samples have twice its variance each, and their
// difference four times.
double RowsFit::VarianceAbout(const Motion& motion, int joint, bool own) const {
  VectorXd apart = Torque(fits_[1], motion, joint, own) -
                   Torque(fits_[2], motion, joint, own);
  if (!own) apart.array() -= apart.mean();
  return left_[joint] +
         .25 * apart.squaredNorm() / static_cast<double>(apart.size());
}

}  // namespace armcal
