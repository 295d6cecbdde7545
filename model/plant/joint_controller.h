#pragma once

#include <Eigen/Core>
#include <string>

#include "model/robot.h"

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
  double rate_hz = 1000;
  Eigen::VectorXd kp;  // n, N m/rad or N/m
  Eigen::VectorXd kd;  // N m s/rad or N s/m
  Eigen::VectorXd ki;  // N m/(rad s) or N/(m s)
  // Of the first-order low pass on differenced positions, Hz.
  double velocity_filter_hz = 100;
  Eigen::VectorXd torque_limit;  // n, N m or N; infinite: none
  Feedforward feedforward = Feedforward::kInverseDynamics;
};

constexpr double kUsualBandwidthHz = 8;
constexpr double kFastestHz = 20000;  // that a controller is simulated at

// Gains that place each joint's closed loop at `bandwidth_hz`, damping ratio 1,
// for the mass matrix (armature included) at q; torque limits are the robot's.
ControllerOptions DefaultController(const Robot& robot,
                                    const Eigen::VectorXd& q,
                                    double bandwidth_hz);

// Reads a controller in YAML over `defaults`, each key optional:
//
//   rate: 1000                    # Hz, 1 to kFastestHz
//   bandwidth: 8                  # Hz; gains as DefaultController sets them
//   kp: [4000, ..]                # per joint, N m/rad or N/m
//   kd: [200, ..]
//   ki: [8000, ..]
//   torque_limit: [150, ..]       # N m or N
//   velocity_filter: 100          # Hz
//   feedforward: inverse_dynamics # or none, gravity
//
// Throws InputError.
ControllerOptions ReadController(const std::string& path, const Robot& robot,
                                 const Eigen::VectorXd& q);

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

// PD with integral and feedforward per joint, at a fixed rate. The integral
// stops while the torque is at its limit and would push it further.
class JointController {
 public:
  // `model` is what the controller knows of the robot.
  JointController(const ControllerOptions& options, const Robot& model);

  // The torque until the next call, one period later.
  Eigen::VectorXd Update(const ReferencePoint& reference,
                         const Eigen::VectorXd& position,
                         const Eigen::VectorXd& velocity);

 private:
  Eigen::VectorXd FeedforwardTorque(const ReferencePoint& reference) const;

  ControllerOptions options_;
  Robot model_;
  Eigen::VectorXd integral_;  // N m or N
};

}  // namespace armcal
