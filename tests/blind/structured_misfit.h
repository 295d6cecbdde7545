#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "model/dynamics/simulated_robot.h"
#include "model/log_files/log.h"
#include "model/robot/robot.h"

namespace armcal {

// What every real robot has beside its effects and no model of it: friction of
// another law at zero velocity, a torque of the position, torque constants that
// are off, and drift, which each log has of its own.
struct StructuredMisfit {
  // A wave of the joint's position: amplitude sin(cycles q + phase).
  struct Ripple {
    double amplitude;  // N m or N
    double cycles;     // per turn of the joint; of a prismatic one 0.3 m is 1
                       // rad
    double phase;      // rad
  };
  struct JointMisfit {
    double usual_torque;   // N m or N, rms in the training log
    double torque_factor;  // recorded torque per torque that the motor gives
    std::vector<Ripple> ripples;
  };

  uint64_t seed = 0;         // of the robot
  double zero_velocity = 0;  // rad/s, the width of its friction
  std::vector<JointMisfit> joints;
};

// Of its usual torque: the rms of a joint's ripples and of its drift.
inline constexpr double kRippleShare = .02, kDriftShare = .01;
// Standard deviation of torque factors.
inline constexpr double kTorqueFactorSpread = .03;

// Of a robot whose training log without misfit is `training`, by streams of
// random numbers that nothing else draws from.
StructuredMisfit DrawMisfit(uint64_t seed, uint32_t attempt, const Robot& robot,
                            double zero_velocity, const Log& training);

// Torque of the ripples at a position, N m or N.
double RippleTorque(const StructuredMisfit::JointMisfit& joint, JointType type,
                    double position);

// Of log `run`: joints x half-cosines over the log, N m or N.
Eigen::MatrixXd DriftOf(const StructuredMisfit& misfit, uint64_t run);
// Of one joint's half-cosines, `share` of the log's duration after its start.
double DriftTorque(const Eigen::VectorXd& half_cosines, double share);

// Makes it part of a plant that has its ordinary friction (AddJointFriction)
// and no effects yet. `duration`: of log `run`, s.
std::function<void(SimulatedRobot*)> PlantMisfit(const StructuredMisfit& misfit,
                                                 uint64_t run, double duration);

// With the drift of logs 0, 1, .. under these names.
nlohmann::json ToJson(const StructuredMisfit& misfit,
                      const std::vector<std::string>& logs);

}  // namespace armcal
