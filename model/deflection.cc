#include "model/deflection.h"

#include <algorithm>
#include <cmath>

#include "model/motion_track.h"
#include "model/stiff_step.h"

namespace armcal {
namespace {

using Eigen::VectorXd;

// Of the fastest oscillation, 1/2 rad per step: beyond that the method damps.
constexpr double kPhasePerStep = .5;
constexpr int kMostSubsteps = 40;
// The link rests on its transmission at first: implicit steps of this length.
constexpr int kSettlingSteps = 20;
constexpr double kSettlingStep = .05;  // s

class DeflectionRun {
 public:
  DeflectionRun(const Transmission& law, const VectorXd& load,
                const VectorXd& inertia, double dt)
      : law_(law),
        signals_(2, load.size()),
        dt_(dt),
        step_(2 + static_cast<int>(law.initial_state.size())),
        x_(2 + law.initial_state.size()),
        unused_(law.initial_state.size()) {
    signals_ << load.transpose(), inertia.transpose();
    x_ << (law.initial_deflection ? law.initial_deflection(load[0]) : 0), 0,
        law.initial_state;
  }

  Deflection Run() {
    const int samples = static_cast<int>(signals_.cols());
    Deflection result = {VectorXd(samples), VectorXd(samples),
                         VectorXd(samples)};
    Settle();
    const int substeps = NumSubsteps();
    for (int k = 0; k < samples; ++k) {
      result.angle[k] = x_[0];
      result.rate[k] = x_[1];
      result.acceleration[k] = Acceleration(signals_.col(k), x_.data());
      if (k + 1 < samples) Advance(k, substeps);
    }
    return result;
  }

 private:
  double Acceleration(const Eigen::Vector2d& signal, const double* x) {
    return (signal[0] - law_.torque(x[0], x[1], x + 2, unused_.data())) /
           signal[1];
  }

  void Rate(const Eigen::Vector2d& signal, const double* x, double* dx) {
    dx[0] = x[1];
    dx[1] = (signal[0] - law_.torque(x[0], x[1], x + 2, dx + 2)) / signal[1];
  }

  void Settle() {
    const Eigen::Vector2d signal = signals_.col(0);
    const StiffStep::Rate rate = [&](double, const double* x, double* dx) {
      Rate(signal, x, dx);
    };
    for (int i = 0; i < kSettlingSteps; ++i) {
      step_.Advance(rate, 0, kSettlingStep, &x_);
    }
  }

  int NumSubsteps() {
    const double dx = 1e-7;
    const double slope =
        (law_.torque(x_[0] + dx, 0, &x_[0] + 2, unused_.data()) -
         law_.torque(x_[0], 0, &x_[0] + 2, unused_.data())) /
        dx;
    const double stiffness = std::max({slope, law_.stiffest, 0.});
    const double omega = std::sqrt(stiffness / signals_.row(1).minCoeff());
    return static_cast<int>(std::clamp(std::ceil(omega * dt_ / kPhasePerStep),
                                       1., 0. + kMostSubsteps));
  }

  void Advance(int k, int substeps) {
    const StiffStep::Rate rate = [&](double t, const double* x, double* dx) {
      InterpolateColumns(signals_, k, t / dt_, &signal_);
      Rate(signal_, x, dx);
    };
    const double h = dt_ / substeps;
    for (int i = 0; i < substeps; ++i) step_.Advance(rate, i * h, h, &x_);
  }

  const Transmission& law_;
  Eigen::MatrixXd signals_;  // load and inertia, samples in columns
  double dt_;
  StiffStep step_;
  VectorXd x_, unused_, signal_;
};

}  // namespace

Deflection FollowDeflection(const Transmission& transmission,
                            const VectorXd& load, const VectorXd& inertia,
                            double dt) {
  return DeflectionRun(transmission, load, inertia, dt).Run();
}

}  // namespace armcal
