#include "model/dynamics/motion_behind_readings.h"

#include <cmath>
#include <functional>

#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Maps are near the identity: the error falls by their slope each time.
constexpr int kIterations = 4;

Reading EmptyReading(int n) {
  const VectorXd zero = VectorXd::Zero(n);
  return {zero, zero, zero, zero};
}

// Recorded position minus true one, samples x n.
MatrixXd PositionErrors(const std::vector<SensorMap>& sensors,
                        const MotionTrack& track) {
  const int n = track.num_joints();
  MatrixXd errors = MatrixXd::Zero(n, track.size());
  ArmInstant instant;
  Reading reading = EmptyReading(n);
  for (int k = 0; k < track.size(); ++k) {
    track.At(k, &instant);
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      instant.position = track.position.col(k) - errors.col(k);
      reading.position = instant.position;
      reading.velocity = instant.velocity;
      for (const SensorMap& map : sensors) map.apply(instant, &reading);
      const VectorXd error = reading.position - instant.position;
      if (error == errors.col(k)) break;
      errors.col(k) = error;
    }
  }
  return errors.transpose();
}

void TakePositionErrors(const MatrixXd& errors, Motion* motion) {
  motion->q -= errors;
  for (int j = 0; j < motion->num_joints(); ++j) {
    if (errors.col(j).maxCoeff() == errors.col(j).minCoeff()) continue;
    const MatrixXd rate = Differentiate(errors.col(j), motion->dt);
    motion->qd.col(j) -= rate;
    motion->qdd.col(j) -= Differentiate(rate, motion->dt);
  }
}

// From derivatives with respect to stamps to those with respect to time.
void TakeClock(const std::function<double(double)>& clock, Motion* motion,
               VectorXd* true_times) {
  const double h = motion->dt;
  for (int k = 0; k < motion->size(); ++k) {
    const double stamp = motion->time(k);
    double& t = (*true_times)[k];
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      t -= clock(t) - stamp;
    }
    const double after = clock(t + h), before = clock(t - h);
    const double rate = (after - before) / (2 * h);
    const double change = (after - 2 * clock(t) + before) / (h * h);
    motion->qdd.row(k) =
        rate * rate * motion->qdd.row(k) + change * motion->qd.row(k);
    motion->qd.row(k) *= rate;
  }
}

// Of stamps that are `share` of their error late.
void TakeStampErrors(double share, Motion* motion, VectorXd* true_times) {
  const VectorXd rate = share * Differentiate(motion->stamp_error, motion->dt);
  const VectorXd change = Differentiate(rate, motion->dt);
  for (int k = 0; k < motion->size(); ++k) {
    const double faster = 1 / (1 - rate[k]);
    motion->qdd.row(k) =
        faster * faster *
        (motion->qdd.row(k) + faster * change[k] * motion->qd.row(k));
    motion->qd.row(k) *= faster;
  }
  *true_times -= share * motion->stamp_error;
}

}  // namespace

bool MotionBehindReadings(const SimulatedRobot& changed, const Motion& recorded,
                          const MotionTrack& track, Motion* motion,
                          VectorXd* true_times) {
  const bool uneven =
      changed.clock_unevenness != 0 && recorded.stamp_error.size() > 0;
  bool differs = changed.clock || uneven;
  MatrixXd errors;
  if (!changed.sensors.empty()) {
    errors = PositionErrors(changed.sensors, track);
    differs = differs || !errors.isZero(0);
  }
  if (!differs) return false;
  *motion = recorded;
  *true_times = track.t;
  if (errors.size() > 0) TakePositionErrors(errors, motion);
  if (uneven) TakeStampErrors(changed.clock_unevenness, motion, true_times);
  if (changed.clock) TakeClock(changed.clock, motion, true_times);
  return true;
}

MatrixXd TorqueReadings(const std::vector<SensorMap>& sensors,
                        const MotionTrack& track, const MatrixXd& torque) {
  MatrixXd readings = torque;
  ArmInstant instant;
  Reading reading = EmptyReading(track.num_joints());
  for (int k = 0; k < track.size(); ++k) {
    track.At(k, &instant);
    reading.position = instant.position;
    reading.velocity = instant.velocity;
    reading.torque = torque.row(k);
    for (const SensorMap& map : sensors) map.apply(instant, &reading);
    readings.row(k) = reading.torque;
  }
  return readings;
}

}  // namespace armcal
