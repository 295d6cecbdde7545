#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/dynamics/drive_law.h"
#include "model/robot/robot.h"

namespace armcal {

enum class Feedforward {
  kNone,
  kGravity,          // of the model at the reference
  kInverseDynamics,  // rigid torque, armature and viscous friction
};

// What to follow at one instant, n entries each.
struct ReferencePoint {
  Eigen::VectorXd q;    // rad or m
  Eigen::VectorXd qd;   // rad/s or m/s
  Eigen::VectorXd qdd;  // rad/s^2 or m/s^2
};

struct ControllerOptions {
  DriveKind kind = DriveKind::kPd;
  double rate_hz = 1000;
  std::vector<DriveLaw> drives;  // per joint
  // From a command to the drives that act on it, pure, s.
  double delay = 0;
  // Of the first-order low pass on differenced positions, Hz.
  double velocity_filter_hz = 100;
  Feedforward feedforward = Feedforward::kInverseDynamics;
};

constexpr double kUsualBandwidthHz = 8;

// Sets the integral gain that goes with the law's own other gains, for a loop
// of bandwidth omega = 2 pi `bandwidth_hz`: of kPd ki = kp omega / 5, whose
// corner ki / kp lies at a fifth of the bandwidth, where it costs the loop
// little phase; of kCascade velocity_ki = kd omega, with the corner at the
// position loop's bandwidth, a fourth of the velocity loop's. kP has none.
void SetIntegralGain(DriveKind kind, double bandwidth_hz, DriveLaw* law);

// Gains that place each joint's closed loop at `bandwidth_hz` for the mass
// matrix (armature included) at q: damping ratio 1 of kp and kd; of a cascade a
// velocity loop four times as fast. Torque limits are the robot's. Only kPd
// knows the robot's inverse dynamics.
ControllerOptions DefaultController(const Robot& robot,
                                    const Eigen::VectorXd& q,
                                    double bandwidth_hz,
                                    DriveKind kind = DriveKind::kPd);

// Velocities from positions at the controller's rate: differences through a
// first-order low pass, 0 at first.
class DifferencedVelocity {
 public:
  explicit DifferencedVelocity(const ControllerOptions& options);
  const Eigen::VectorXd& Update(const Eigen::VectorXd& position);

 private:
  double rate_hz_, decay_;
  Eigen::VectorXd last_position_, velocity_;
};

// The drives of all joints at a fixed rate, with feedforward. Their delay and
// lags are those of the path to and from them, and not in here.
class JointController {
 public:
  // `model` is what the controller knows of the robot.
  JointController(const ControllerOptions& options, const Robot& model);

  // The torque until the next call, one period later.
  Eigen::VectorXd Update(const ReferencePoint& reference,
                         const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity);
  // The same with the feedforward, n, calculated elsewhere.
  Eigen::VectorXd Update(const ReferencePoint& reference,
                         const Eigen::VectorXd& feedforward,
                         const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity);

  bool at_limit() const { return at_limit_; }  // some torque of the last one

 private:
  Eigen::VectorXd FeedforwardTorque(const ReferencePoint& reference) const;

  ControllerOptions options_;
  Robot model_;
  Eigen::VectorXd integral_;  // N m or N
  bool at_limit_ = false;
};

}  // namespace armcal
