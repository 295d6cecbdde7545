#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/diagnose/data/segment.h"
#include "model/dynamics/recorded_torque.h"
#include "model/effects/effect.h"
#include "model/robot/robot.h"

namespace armcal {

// What a model of a real robot lacks as a rule, on each joint for itself: a
// torque that depends on position (ripple of gears and cables below six cycles
// per turn), on position and direction (friction along the way), on velocity
// (a friction law of another form), on load, on the state of the whole arm and
// on time, and that is off by a factor, as torque constants are. It is a
// Gaussian process of a routine, bounded size,
//   d(t) = sum_k c_k phi_k(state(t)),   c_k ~ N(0, spread_k^2),
// with fixed shapes phi_k (random Fourier features, Rahimi and Recht 2007,
// where the whole state matters). As nuisance columns of the baseline these
// keep a diagnosis from naming an effect for what is routine (Kennedy and
// O'Hagan 2001). Their size is bounded: left free it swallows effects, as much
// as all of the torque of four joints of a real arm. Amplitudes were chosen on
// 90 simulated arms with and without misfit and three real ones (KR300, TX40,
// UR10e), where rules of inference were compared.
class Discrepancy {
 public:
  Discrepancy() = default;
  // `logs`: how many there are, each of which drifts for itself. Torque
  // constants have that relative standard deviation.
  Discrepancy(const Robot& robot, const MotionScale& scale, int logs,
              double torque_constants_stddev);
  double torque_constants_stddev() const { return torque_constants_stddev_; }

  // Standard deviations of joint j's coefficients, N m or N.
  Eigen::VectorXd Spreads(int j, const Joint& joint) const;
  // Shapes of joint j in a segment: samples x as many, of the order of 1.
  Eigen::MatrixXd Torque(int j, const GapSegment& segment,
                         const RecordedTorque& torque) const;
  // How large it is at any one time, a standard deviation (N m or N), but for
  // the torque constant, which a reference of the same joint shares.
  double Deviation(int j, const Joint& joint) const;
  // Whether shape k is of one log's time: other logs do not share it.
  bool IsOfTime(int k) const;

 private:
  Eigen::MatrixXd State(const Motion& motion) const;

  MotionScale scale_;
  int logs_ = 0;
  double torque_constants_stddev_ = 0;
  Eigen::VectorXd per_turn_;                // rad of a turn per rad or m
  std::vector<Eigen::MatrixXd> frequency_;  // per joint, of the state
  std::vector<Eigen::VectorXd> phase_;
};

}  // namespace armcal
