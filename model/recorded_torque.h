#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/joint_term.h"
#include "model/motion.h"
#include "model/motion_track.h"
#include "model/robot.h"
#include "model/simulated_robot.h"
#include "model/wrench_torque.h"

namespace armcal {

// The torque that a controller records while the motors of a robot move as its
// encoders recorded: inverse dynamics with the slots of a SimulatedRobot.
// Keeps what does not change from one question to the next; one per thread.
class RecordedTorque {
 public:
  // The robot without effects; its joints' friction changes sign as
  // `transitions` say (n entries).
  RecordedTorque(const Robot& robot, std::vector<CoulombTransition> transitions,
                 Motion motion);

  const Motion& motion() const { return motion_; }
  // Of the robot itself, samples x n, N m or N: links, armature, joint terms.
  const Eigen::MatrixXd& nominal() const { return nominal_; }
  // What drives hand to their links: without armature and friction.
  const Eigen::MatrixXd& load() const { return load_; }
  // What its friction heats the joints with, W, samples x n.
  const Eigen::MatrixXd& friction_power() const { return friction_power_; }

  // What the slots of `changed` add to the nominal torque, samples x n.
  // `changed` has the robot of the constructor, itself perhaps changed (links,
  // gravity, joint terms, a geometry), and no laws but those to be judged:
  //   joint laws and wrenches   exact, with their states along the motion. They
  //                             see the nominal load, and the temperature that
  //                             was recorded (above the usual one) or that
  //                             `thermal` makes of nominal friction;
  //   robot                     exact;
  //   transmissions             the deflection's equation of motion along the
  //                             recorded motion of the motor (deflection.h),
  //                             then inverse dynamics of the links;
  //   sensors, clock            the motion behind the readings, and the
  //                             recorded torque;
  //   torque_delay              interpolated between samples
  //   actuators                 inverted from the torque needed, with the help
  //                             of the recorded one (actuator_inversion.h).
  Eigen::MatrixXd Change(const SimulatedRobot& changed);

 private:
  void FollowWarmth(const std::vector<JointThermal>& thermal);
  const Eigen::MatrixXd& Inertia();
  Eigen::MatrixXd RigidTorque(const Robot& robot, const Motion& motion,
                              bool as_recorded) const;
  void AddTransmissions(const SimulatedRobot& changed, const Motion& motion,
                        MotionTrack* track, Eigen::MatrixXd* tau);
  void AddLaws(const SimulatedRobot& changed, const MotionTrack& track,
               Eigen::MatrixXd* tau);
  Eigen::MatrixXd Recorded(const SimulatedRobot& changed,
                           const MotionTrack& track,
                           const Eigen::MatrixXd& needed) const;

  Robot robot_;
  std::vector<CoulombTransition> transitions_;
  Motion motion_;
  Eigen::MatrixXd nominal_, load_;
  Eigen::MatrixXd friction_power_;  // W, samples x n
  MotionTrack track_;
  std::vector<JointThermal> thermal_;  // behind track_.warmth
  Eigen::MatrixXd inertia_;  // see Inertia(); empty: not yet asked for
  AttachedPoints points_;    // asked for last, of robot_ along motion_
};

}  // namespace armcal
