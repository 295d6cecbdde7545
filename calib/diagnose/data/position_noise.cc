#include "calib/diagnose/data/position_noise.h"

#include <vector>

#include "model/signals/low_pass.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;

// Of a robot without friction, whose sign noise would change near standstill.
class NoiseTorque {
 public:
  explicit NoiseTorque(const GapBaseline& baseline)
      : robot_(baseline.robot()), transitions_(baseline.transitions()) {
    for (Link& link : robot_.links) link.joint.coulomb = 0;
  }

  // Of what the drives gave, less of what the motion needs; samples x n, N m or
  // N. The noise of the positions is in the torque through the drives' law and
  // in the inverse dynamics through differentiated motion: what is told apart
  // from the model is their difference.
  MatrixXd Of(const GapSegment& segment) const {
    Motion shaken = segment.motion;
    const MatrixXd qd = Differentiate(segment.position_noise, shaken.dt);
    shaken.q += segment.position_noise;
    shaken.qd += qd;
    shaken.qdd += Differentiate(qd, shaken.dt);
    return segment.torque_noise - (Needed(shaken) - Needed(segment.motion));
  }

 private:
  MatrixXd Needed(const Motion& motion) const {
    return RecordedTorque(robot_, transitions_, motion).nominal();
  }

  Robot robot_;
  std::vector<CoulombTransition> transitions_;
};

}  // namespace

GapNoise NoiseOfPositions(const GapBaseline& baseline, const GapRows& rows) {
  constexpr double kLeast = 1e-12;  // N m or N, of encoders without noise
  const NoiseTorque torque(baseline);
  std::vector<MatrixXd> noise;
  for (const GapSegment& segment : rows.segments()) {
    noise.push_back(torque.Of(segment));
  }
  MatrixXd thin = rows.ThinAll(noise);
  for (int j = 0; j < thin.cols(); ++j) {
    thin.col(j) = rows.WithoutDrift(j, thin.col(j));
  }
  GapNoise of_positions = ResidualNoise(rows, thin);
  for (int j = 0; j < thin.cols(); ++j) {
    if (thin.col(j).isZero(0)) of_positions.joints[j].sigma = kLeast;
  }
  of_positions.source = NoiseFloor::kPositions;
  return of_positions;
}

}  // namespace armcal
