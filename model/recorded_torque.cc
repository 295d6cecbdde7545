#include "model/recorded_torque.h"

#include <glog/logging.h>

#include "model/actuator_inversion.h"
#include "model/deflection.h"
#include "model/delayed_signal.h"
#include "model/forward_dynamics.h"
#include "model/inverse_dynamics.h"
#include "model/joint_warmth.h"
#include "model/motion_behind_readings.h"
#include "model/stiff_step.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Steps per sample of the states of joint laws.
constexpr int kSubsteps = 2;

bool SameLinks(const Robot& a, const Robot& b) {
  if (a.gravity != b.gravity) return false;
  for (int i = 0; i < a.num_joints(); ++i) {
    const Link &x = a.links[i], &y = b.links[i];
    const InertialParameters &u = x.inertial, &v = y.inertial;
    if (x.X_PF.matrix() != y.X_PF.matrix() ||
        x.X_ML.matrix() != y.X_ML.matrix() || u.mass != v.mass ||
        u.first_moment != v.first_moment || u.inertia != v.inertia) {
      return false;
    }
  }
  return true;
}

bool SameJointTerms(const Robot& a, const Robot& b) {
  for (int i = 0; i < a.num_joints(); ++i) {
    const Joint &x = a.links[i].joint, &y = b.links[i].joint;
    if (x.viscous != y.viscous || x.coulomb != y.coulomb ||
        x.armature != y.armature || x.offset != y.offset) {
      return false;
    }
  }
  return true;
}

bool SameThermal(const std::vector<JointThermal>& a,
                 const std::vector<JointThermal>& b) {
  if (a.size() != b.size()) return false;
  for (size_t j = 0; j < a.size(); ++j) {
    if (a[j].capacity != b[j].capacity || a[j].resistance != b[j].resistance) {
      return false;
    }
  }
  return true;
}

MatrixXd LinkTorque(const Robot& robot, const Motion& motion) {
  MatrixXd tau(motion.size(), motion.num_joints());
  for (int k = 0; k < motion.size(); ++k) {
    tau.row(k) = InverseDynamics(robot, motion.q.row(k), motion.qd.row(k),
                                 motion.qdd.row(k));
  }
  return tau;
}

// The joints' states of Coulomb friction, samples x n.
MatrixXd CoulombAlong(const std::vector<CoulombTransition>& transitions,
                      const Motion& motion) {
  std::vector<JointTermColumn> columns;
  for (int j = 0; j < motion.num_joints(); ++j) {
    columns.push_back({j, JointTerm::kCoulomb, transitions[j]});
  }
  Trajectory trajectory;
  trajectory.dt = motion.dt;
  trajectory.q = motion.q;
  trajectory.qd = motion.qd;
  return CoulombStates(columns).Follow(trajectory);
}

// Viscous and Coulomb friction and offsets.
MatrixXd FrictionTorque(const Robot& robot, const Motion& motion,
                        const MatrixXd& coulomb) {
  MatrixXd tau(motion.size(), motion.num_joints());
  for (int j = 0; j < motion.num_joints(); ++j) {
    const Joint& joint = robot.links[j].joint;
    tau.col(j) = joint.viscous * motion.qd.col(j) +
                 joint.coulomb * coulomb.col(j) +
                 VectorXd::Constant(motion.size(), joint.offset);
  }
  return tau;
}

void AddArmature(const Robot& robot, const Motion& motion, MatrixXd* tau) {
  for (int j = 0; j < motion.num_joints(); ++j) {
    tau->col(j) += robot.links[j].joint.armature * motion.qdd.col(j);
  }
}

// Torque of the law at every sample.
VectorXd Along(const JointLaw& law, const MotionTrack& track) {
  VectorXd torque(track.size()), x = law.initial_state, unused = x;
  StiffStep step(static_cast<int>(x.size()));
  ArmInstant instant, between;
  int k = 0;
  double at = -1;  // the share that `between` is of
  const auto rate = [&](double share, const double* state, double* dx) {
    if (share != at) track.Between(k, share, &between);
    at = share;
    law.torque(between, state, dx);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      dx[i] *= track.t[k + 1] - track.t[k];
    }
  };
  for (; k < track.size(); ++k) {
    track.At(k, &instant);
    torque[k] = law.torque(instant, x.data(), unused.data());
    if (x.size() == 0 || k + 1 == track.size()) continue;
    at = -1;
    const double share = 1. / kSubsteps;
    for (int i = 0; i < kSubsteps; ++i)
      step.Advance(rate, i * share, share, &x);
  }
  return torque;
}

}  // namespace

RecordedTorque::RecordedTorque(const Robot& robot,
                               std::vector<CoulombTransition> transitions,
                               Motion motion)
    : robot_(robot),
      transitions_(std::move(transitions)),
      motion_(std::move(motion)) {
  const int n = robot_.num_joints();
  CHECK(motion_.size() > 0 && motion_.dt > 0);
  CHECK_EQ(motion_.num_joints(), n);
  CHECK_EQ(transitions_.size(), static_cast<size_t>(n));
  load_ = LinkTorque(robot_, motion_);
  const MatrixXd friction =
      FrictionTorque(robot_, motion_, CoulombAlong(transitions_, motion_));
  nominal_ = load_ + friction;
  AddArmature(robot_, motion_, &nominal_);
  friction_power_ = friction.cwiseProduct(motion_.qd);
  for (int j = 0; j < n; ++j) {
    friction_power_.col(j) -= robot_.links[j].joint.offset * motion_.qd.col(j);
  }
  track_.SetMotion(motion_);
  track_.load = load_.transpose();
  FollowWarmth({});
}

void RecordedTorque::FollowWarmth(const std::vector<JointThermal>& thermal) {
  if (track_.warmth.size() > 0 && SameThermal(thermal, thermal_)) return;
  thermal_ = thermal;
  if (motion_.temperature.size() > 0) {
    track_.warmth = motion_.temperature.transpose();
    if (motion_.usual_temperature.size() > 0) {
      track_.warmth.colwise() -= motion_.usual_temperature;
    } else {
      track_.warmth.colwise() -= motion_.temperature.row(0).transpose().eval();
    }
    return;
  }
  track_.warmth = JointWarmth(
      friction_power_, motion_.dt,
      thermal.empty() ? std::vector<JointThermal>(robot_.num_joints())
                      : thermal);
}

// Links and joint terms of a changed robot, or along another motion.
MatrixXd RecordedTorque::RigidTorque(const Robot& robot, const Motion& motion,
                                     bool as_recorded) const {
  MatrixXd tau = as_recorded && SameLinks(robot, robot_)
                     ? load_
                     : LinkTorque(robot, motion);
  tau += FrictionTorque(robot, motion, CoulombAlong(transitions_, motion));
  AddArmature(robot, motion, &tau);
  return tau;
}

// Diagonals of the mass matrix along the recorded motion, samples x n.
const MatrixXd& RecordedTorque::Inertia() {
  if (inertia_.size() > 0) return inertia_;
  inertia_.resize(motion_.size(), robot_.num_joints());
  for (int k = 0; k < motion_.size(); ++k) {
    inertia_.row(k) = LinkInertias(robot_, motion_.q.row(k));
  }
  return inertia_;
}

void RecordedTorque::AddTransmissions(const SimulatedRobot& changed,
                                      const Motion& motion, MotionTrack* track,
                                      MatrixXd* tau) {
  const bool recorded = &motion == &motion_ && SameLinks(changed.robot, robot_);
  const MatrixXd load = recorded ? load_ : LinkTorque(changed.robot, motion);
  Motion links = motion;
  for (const Transmission& law : changed.transmissions) {
    const int j = law.joint;
    const Deflection d =
        FollowDeflection(law, load.col(j), Inertia().col(j), motion.dt);
    links.q.col(j) -= d.angle;
    links.qd.col(j) -= d.rate;
    links.qdd.col(j) -= d.acceleration;
  }
  *tau += LinkTorque(changed.robot, links) - load;
  track->deflection = (motion.q - links.q).transpose();
  track->deflection_rate = (motion.qd - links.qd).transpose();
}

void RecordedTorque::AddLaws(const SimulatedRobot& changed,
                             const MotionTrack& track, MatrixXd* tau) {
  for (const JointLaw& law : changed.joint_laws) {
    tau->col(law.joint) -= Along(law, track);
  }
  for (const WrenchLaw& law : changed.wrenches) {
    const Attachment& at = law.attachment;
    if (&track != &track_ || !SameLinks(changed.robot, robot_)) {
      TakeWrench(law, track, FollowPoints(changed.robot, track, at).at, tau);
      continue;
    }
    if (points_.at.empty() || points_.attachment.link != at.link ||
        points_.attachment.p_LP != at.p_LP) {
      points_ = FollowPoints(robot_, track_, at);
    }
    TakeWrench(law, track, points_.at, tau);
  }
}

// What the log holds when the motors give what is needed.
MatrixXd RecordedTorque::Recorded(const SimulatedRobot& changed,
                                  const MotionTrack& track,
                                  const MatrixXd& needed) const {
  MatrixXd tau = needed;
  if (!changed.actuators.empty()) {
    tau = CommandFor(changed.actuators, track, needed, motion_.torque);
  }
  if (!changed.sensors.empty()) {
    tau = TorqueReadings(changed.sensors, track, tau);
  }
  if (changed.torque_delay != 0) {
    tau = Delayed(tau, changed.torque_delay / motion_.dt);
  }
  return tau;
}

MatrixXd RecordedTorque::Change(const SimulatedRobot& changed) {
  CHECK_EQ(changed.robot.num_joints(), robot_.num_joints());
  CHECK_EQ(changed.num_passive, 0);
  FollowWarmth(changed.thermal);
  Motion moved;
  VectorXd times;
  const bool as_recorded =
      !MotionBehindReadings(changed, motion_, track_, &moved, &times);
  const Motion& motion = as_recorded ? motion_ : moved;
  const bool same_robot = as_recorded && SameLinks(changed.robot, robot_) &&
                          SameJointTerms(changed.robot, robot_);
  MatrixXd tau =
      same_robot ? nominal_ : RigidTorque(changed.robot, motion, as_recorded);
  if (as_recorded && changed.transmissions.empty()) {
    AddLaws(changed, track_, &tau);
    return Recorded(changed, track_, tau) - nominal_;
  }
  MotionTrack track = track_;
  if (!as_recorded) {
    track.SetMotion(moved);
    track.t = times;
  }
  if (!changed.transmissions.empty()) {
    AddTransmissions(changed, motion, &track, &tau);
  }
  AddLaws(changed, track, &tau);
  return Recorded(changed, track, tau) - nominal_;
}

}  // namespace armcal
