#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/joint_term.h"
#include "model/motion.h"
#include "model/robot.h"
#include "model/simulated_robot.h"

namespace armcal {

// The torque that a controller records while the motors of a robot move as its
// encoders recorded: inverse dynamics with the slots of a SimulatedRobot.
// Keeps what does not change from one question to the next.
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

  // What the slots of `changed` add to the nominal torque, samples x n.
  // `changed` has the robot of the constructor, itself perhaps changed (links,
  // gravity, armature, a geometry), and no laws but those to be judged:
  //   joint laws and wrenches   exact, with their states along the motion;
  //   robot                     exact;
  //   transmissions             the deflection's equation of motion along the
  //                             recorded motion of the motor; other rows to
  //                             first order in the deflection;
  //   sensors, clock            the motion behind the readings, and the
  //                             recorded torque;
  //   actuators                 inverted by iteration from the torque needed.
  Eigen::MatrixXd Change(const SimulatedRobot& changed);

 private:
  Robot robot_;
  std::vector<CoulombTransition> transitions_;
  Motion motion_;
  Eigen::MatrixXd nominal_, load_;
};

}  // namespace armcal
