#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "model/dynamics/deflected_links.h"
#include "model/dynamics/joint_term.h"
#include "model/dynamics/joint_warmth.h"
#include "model/dynamics/motion_track.h"
#include "model/dynamics/rigid_torque.h"
#include "model/dynamics/simulated_robot.h"
#include "model/dynamics/wrench_torque.h"
#include "model/robot/robot.h"
#include "model/signals/motion.h"

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
  // What its friction heats the joints with.
  const FrictionPower& friction_power() const { return friction_power_; }
  // What the joints are known to give beyond the nominal torque, samples x n:
  // a delay moves it as well (recording_delay.h), and nothing else sees it.
  void SetBeyondNominal(Eigen::MatrixXd torque) {
    beyond_nominal_ = std::move(torque);
  }

  // Per joint, torque at the samples, N m or N; empty where it is nothing.
  using OfJoints = std::vector<Eigen::VectorXd>;
  // What the slots of each of `changed` add to the nominal torque; which others
  // there are makes no difference but to the time it takes.
  // Each has the robot of the constructor, itself perhaps changed (links,
  // gravity, joint terms, a geometry), and no laws but those to be judged:
  //   joint laws and wrenches   exact, with their states along the motion. They
  //                             see the nominal load, and the temperature that
  //                             was recorded (above the usual one) or that
  //                             `thermal` makes of nominal friction and of
  //                             what warmth leaves of it;
  //   robot                     exact;
  //   transmissions             the deflection's equation of motion along the
  //                             recorded motion of the motor (deflection.h),
  //                             then inverse dynamics of the links;
  //   sensors, clock            the motion behind the readings, and the
  //                             recorded torque, or what the clock made of one
  //                             that was made of the readings;
  //   torque_delay              recording_delay.h
  //   actuators                 inverted from the torque needed, with the help
  //                             of the recorded one (actuator_inversion.h).
  std::vector<OfJoints> Changes(const std::vector<SimulatedRobot>& changed);
  // The same of one, samples x n.
  Eigen::MatrixXd Change(const SimulatedRobot& changed);

 private:
  // What is worked out when it is first asked for, once for all copies.
  struct Kept {
    std::mutex mutex;
    LinkTorqueSlopes slopes;  // empty: not yet asked for
    std::vector<std::shared_ptr<const AttachedPoints>> points;
  };
  void FollowWarmth(const std::vector<JointThermal>& thermal);
  bool IsOfLawsAlone(const SimulatedRobot& changed) const;
  // The links behind transmissions of those whose motors move as recorded; of
  // the others, and of those without, none.
  using Links = std::shared_ptr<const DeflectedLinks>;
  std::vector<Links> FollowTransmissions(
      const std::vector<SimulatedRobot>& changed, LinkTorques* loads) const;
  // What is the same for several of the changed robots: their links' loads
  // along the recorded motion, the links behind this one's transmissions, and
  // the torques of its joint laws along the recorded motion (empty: to be
  // followed yet).
  struct Shared {
    LinkTorques* loads;
    Links links;
    std::vector<Eigen::VectorXd> laws;
  };
  Eigen::MatrixXd ChangeOf(const SimulatedRobot& changed, const Shared& shared);
  MotionTrack TrackOf(const Motion& motion, const Eigen::VectorXd& times,
                      const DeflectedLinks* links) const;
  void AddChanges(const std::vector<SimulatedRobot>& changed,
                  const std::vector<size_t>& which,
                  const std::vector<Links>& links, LinkTorques* loads,
                  std::vector<OfJoints>* to);
  const LinkTorqueSlopes& Slopes() const;
  const AttachedPoints& PointsOf(const Attachment& attachment) const;
  Eigen::MatrixXd RigidTorque(const Robot& robot, const Motion& motion,
                              const Eigen::MatrixXd& load,
                              bool as_recorded) const;
  void AddWrenches(const SimulatedRobot& changed, const MotionTrack& track,
                   Eigen::MatrixXd* tau) const;
  void AddMadeByClock(const std::function<double(double)>& clock,
                      Eigen::MatrixXd* tau) const;
  Eigen::MatrixXd Recorded(const SimulatedRobot& changed,
                           const MotionTrack& track,
                           Eigen::MatrixXd needed) const;

  Robot robot_;
  std::vector<CoulombTransition> transitions_;
  Motion motion_;
  Eigen::MatrixXd nominal_, load_;
  Eigen::MatrixXd beyond_nominal_;  // empty: nothing
  Eigen::MatrixXd coulomb_;         // states of Coulomb friction, samples x n
  FrictionPower friction_power_;
  MotionTrack track_;
  std::vector<JointThermal> thermal_;  // behind track_.warmth
  std::shared_ptr<Kept> kept_;
};

}  // namespace armcal
