#include "model/dynamics/actuator_inversion.h"

#include <cmath>

#include "model/dynamics/motor_map.h"
#include "model/signals/stiff_step.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostSteps = 8;
constexpr double kClose = 1e-10;  // of the largest torque
constexpr int kLagSteps = 12;
constexpr double kLagTolerance = 1e-5;
// A step that takes less than this share from what was missing did not help:
// the map is (nearly) flat there. One that takes more than all of it did, since
// its slope is known then: a motor that gives three times what is asked of it
// overshoots by twice of what was missing.
constexpr double kLeastProgress = .2;
// Lags shorter than a sample follow the slope of what they are given.
constexpr int kSubsteps = 2;
// What stood before the first sample, s, in implicit steps.
constexpr int kSettlingSteps = 10;
constexpr double kSettlingStep = .1;

int NumStates(const std::vector<ActuatorMap>& actuators) {
  Eigen::Index size = 0;
  for (const ActuatorMap& map : actuators) size += map.initial_state.size();
  return static_cast<int>(size);
}

void Apply(const std::vector<ActuatorMap>& actuators, const ArmInstant& instant,
           const double* state, double* rate, VectorXd* torque) {
  for (const ActuatorMap& map : actuators) {
    map.apply(instant, state, rate, torque);
    state += map.initial_state.size();
    rate += map.initial_state.size();
  }
}

// Maps with states, along the motion.
class ActuatorRun {
 public:
  ActuatorRun(const std::vector<ActuatorMap>& actuators,
              const MotionTrack& track, const MatrixXd& commanded)
      : actuators_(actuators),
        track_(track),
        commanded_(commanded.transpose()),
        step_(NumStates(actuators)),
        x_(NumStates(actuators)),
        unused_(NumStates(actuators)) {
    Eigen::Index at = 0;
    for (const ActuatorMap& map : actuators) {
      x_.segment(at, map.initial_state.size()) = map.initial_state;
      at += map.initial_state.size();
    }
  }

  MatrixXd Run() {
    MatrixXd given(commanded_.rows(), commanded_.cols());
    Settle();
    for (int k = 0; k < track_.size(); ++k) {
      track_.At(k, &instant_);
      torque_ = commanded_.col(k);
      Apply(actuators_, instant_, x_.data(), unused_.data(), &torque_);
      given.col(k) = torque_;
      if (k + 1 < track_.size()) Advance(k);
    }
    return given.transpose();
  }

 private:
  void Settle() {
    track_.At(0, &instant_);
    const auto rate = [this](double, const double* x, double* dx) {
      torque_ = commanded_.col(0);
      Apply(actuators_, instant_, x, dx, &torque_);
    };
    for (int i = 0; i < kSettlingSteps; ++i) {
      step_.Advance(rate, 0, kSettlingStep, &x_);
    }
  }

  // From sample k to the next.
  void Advance(int k) {
    const double begin = track_.t[k], dt = track_.t[k + 1] - begin;
    const auto rate = [&](double t, const double* x, double* dx) {
      const double share = (t - begin) / dt;
      track_.Between(k, share, &instant_);
      InterpolateColumns(commanded_, k, share, &torque_);
      Apply(actuators_, instant_, x, dx, &torque_);
    };
    for (int i = 0; i < kSubsteps; ++i) {
      step_.Advance(rate, begin + i * dt / kSubsteps, dt / kSubsteps, &x_);
    }
  }

  const std::vector<ActuatorMap>& actuators_;
  const MotionTrack& track_;
  MatrixXd commanded_;  // n x samples
  StiffStep step_;
  VectorXd x_, unused_, torque_;
  ArmInstant instant_;
};

// Maps without states, at sample k.
class InstantMaps {
 public:
  InstantMaps(const std::vector<ActuatorMap>& actuators,
              const MotionTrack& track)
      : actuators_(actuators), track_(track) {}

  void Give(const MatrixXd& commanded, int k, MatrixXd* given) {
    track_.At(k, &instant_);
    torque_ = commanded.row(k);
    Apply(actuators_, instant_, nullptr, nullptr, &torque_);
    given->row(k) = torque_;
  }

 private:
  const std::vector<ActuatorMap>& actuators_;
  const MotionTrack& track_;
  ArmInstant instant_;
  VectorXd torque_;
};

// By how much to change commands for `missing`, by the slope of the maps that
// the last change `step` of the commands showed.
void Secant(const MatrixXd& missing_before, const MatrixXd& missing,
            MatrixXd* step) {
  for (Eigen::Index i = 0; i < missing.size(); ++i) {
    const double gained = missing_before(i) - missing(i);
    double& s = (*step)(i);
    s = gained == 0 ? missing(i) : missing(i) * s / gained;
  }
}

}  // namespace

MatrixXd GivenTorque(const std::vector<ActuatorMap>& actuators,
                     const MotionTrack& track, const MatrixXd& commanded) {
  if (NumStates(actuators) > 0) {
    return ActuatorRun(actuators, track, commanded).Run();
  }
  MatrixXd given(commanded.rows(), commanded.cols());
  InstantMaps maps(actuators, track);
  for (int k = 0; k < track.size(); ++k) maps.Give(commanded, k, &given);
  return given;
}

namespace {

// The command for which one motor gives what is needed at this velocity: as
// InvertMap, of one number.
double InvertAt(const MotorMap& motor, double velocity, double needed,
                double guess, double close) {
  double commanded = guess;
  double missing = needed - motor.given(commanded, velocity), step = missing;
  for (int i = 0; i < kMostSteps && std::abs(missing) > close; ++i) {
    commanded += step;
    const double before = missing;
    missing = needed - motor.given(commanded, velocity);
    if (!((before - missing) / before > kLeastProgress)) break;
    step = missing * step / (before - missing);
  }
  return commanded;
}

// From what is needed of the motors to what is asked of them, in place.
void InvertMotor(const MotorMap& motor, const MotionTrack& track,
                 const MatrixXd& guess, MatrixXd* torque) {
  const int j = motor.joint;
  if (motor.commanded) {
    for (double& one : torque->col(j)) one = motor.commanded(one);
    return;
  }
  const double close = kClose * torque->cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; k < torque->rows(); ++k) {
    (*torque)(k, j) = InvertAt(motor, track.velocity(j, k), (*torque)(k, j),
                               guess(k, j), close);
  }
}

// Of one map without states, sample by sample.
MatrixXd InvertMap(const std::vector<ActuatorMap>& map,
                   const MotionTrack& track, const MatrixXd& needed,
                   const MatrixXd& guess) {
  const double close = kClose * needed.cwiseAbs().maxCoeff();
  MatrixXd commanded = guess;
  MatrixXd given = GivenTorque(map, track, commanded);
  MatrixXd missing = needed - given;
  MatrixXd step = missing;
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> open =
      missing.array().abs() > close;
  InstantMaps maps(map, track);
  for (int i = 0; i < kMostSteps && open.any(); ++i) {
    commanded += open.select(step, 0);
    const MatrixXd before = missing;
    // Of other samples nothing has changed.
    for (int k = 0; k < track.size(); ++k) {
      if (open.row(k).any()) maps.Give(commanded, k, &given);
    }
    missing = needed - given;
    open = open && missing.array().abs() > close &&
           (before - missing).array() / before.array() > kLeastProgress;
    Secant(before, missing, &step);
  }
  return commanded;
}

// Of one map with states, which lags: what is missing falls by the share of a
// signal that the lag lets through, each time.
MatrixXd InvertLag(const std::vector<ActuatorMap>& map,
                   const MotionTrack& track, const MatrixXd& needed) {
  MatrixXd commanded = needed;
  for (int i = 0; i < kLagSteps; ++i) {
    const MatrixXd missing = needed - GivenTorque(map, track, commanded);
    commanded += missing;
    if (missing.norm() <= kLagTolerance * needed.norm()) break;
  }
  return commanded;
}

}  // namespace

MatrixXd CommandFor(const std::vector<ActuatorMap>& actuators,
                    const MotionTrack& track, const MatrixXd& needed,
                    const MatrixXd& guess) {
  MatrixXd commanded = needed;
  for (auto map = actuators.rbegin(); map != actuators.rend(); ++map) {
    const MatrixXd& from = guess.size() > 0 ? guess : commanded;
    const auto* motor = map->apply.target<MotorMap>();
    if (map->initial_state.size() > 0) {
      commanded = InvertLag({*map}, track, commanded);
    } else if (motor != nullptr) {
      InvertMotor(*motor, track, from, &commanded);
    } else {
      commanded = InvertMap({*map}, track, commanded, from);
    }
  }
  return commanded;
}

}  // namespace armcal
