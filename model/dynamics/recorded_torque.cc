#include "model/dynamics/recorded_torque.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "model/dynamics/actuator_inversion.h"
#include "model/dynamics/joint_law_torques.h"
#include "model/dynamics/joint_warmth.h"
#include "model/dynamics/motion_behind_readings.h"
#include "model/signals/recording_delay.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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

RecordedTorque::OfJoints WithoutNothing(const MatrixXd& tau) {
  RecordedTorque::OfJoints joints(tau.cols());
  for (Eigen::Index j = 0; j < tau.cols(); ++j) {
    if (!tau.col(j).isZero(0)) joints[j] = tau.col(j);
  }
  return joints;
}

}  // namespace

RecordedTorque::RecordedTorque(const Robot& robot,
                               std::vector<CoulombTransition> transitions,
                               Motion motion)
    : robot_(robot),
      transitions_(std::move(transitions)),
      motion_(std::move(motion)),
      kept_(std::make_shared<Kept>()) {
  const int n = robot_.num_joints();
  CHECK(motion_.size() > 0 && motion_.dt > 0);
  CHECK_EQ(motion_.num_joints(), n);
  CHECK_EQ(transitions_.size(), static_cast<size_t>(n));
  load_ = LinkTorque(robot_, motion_);
  coulomb_ = CoulombAlong(transitions_, motion_);
  const MatrixXd friction = FrictionTorque(robot_, motion_, coulomb_);
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
  tau += FrictionTorque(
      robot, motion,
      as_recorded ? coulomb_ : CoulombAlong(transitions_, motion));
  AddArmature(robot, motion, &tau);
  return tau;
}

// Along the recorded motion.
const LinkTorqueSlopes& RecordedTorque::Slopes() const {
  const std::lock_guard<std::mutex> lock(kept_->mutex);
  LinkTorqueSlopes& slopes = kept_->slopes;
  if (slopes.inertia.size() == 0) slopes = SlopesOfLinkTorque(robot_, motion_);
  return slopes;
}

// `load`: of all joints. A motion behind readings is close to the recorded one.
DeflectedJoint RecordedTorque::Deflected(const Transmission& transmission,
                                         const MatrixXd& load) const {
  const int j = transmission.joint;
  const LinkTorqueSlopes& slopes = Slopes();
  return {&transmission, load.col(j), slopes.stiffness.col(j),
          slopes.damping.col(j), slopes.inertia.col(j)};
}

// Of the robot itself along the recorded motion.
const AttachedPoints& RecordedTorque::PointsOf(
    const Attachment& attachment) const {
  const std::lock_guard<std::mutex> lock(kept_->mutex);
  for (const auto& points : kept_->points) {
    if (points->attachment.link == attachment.link &&
        points->attachment.p_LP == attachment.p_LP) {
      return *points;
    }
  }
  kept_->points.push_back(std::make_shared<const AttachedPoints>(
      FollowPoints(robot_, track_, attachment)));
  return *kept_->points.back();
}

// Of those whose motors and links move as recorded; none of the others.
std::vector<std::vector<Deflection>> RecordedTorque::DeflectTogether(
    const std::vector<SimulatedRobot>& changed) const {
  std::vector<DeflectedJoint> joints;
  std::vector<size_t> of;
  for (size_t i = 0; i < changed.size(); ++i) {
    const SimulatedRobot& one = changed[i];
    if (one.transmissions.empty() || !one.sensors.empty() || one.clock ||
        one.clock_unevenness != 0 || !SameLinks(one.robot, robot_)) {
      continue;
    }
    for (const Transmission& law : one.transmissions) {
      joints.push_back(Deflected(law, load_));
      of.push_back(i);
    }
  }
  std::vector<std::vector<Deflection>> deflections(changed.size());
  std::vector<Deflection> all = FollowDeflections(joints, motion_.dt);
  for (size_t k = 0; k < all.size(); ++k) {
    deflections[of[k]].push_back(std::move(all[k]));
  }
  return deflections;
}

// `deflections`: of the transmissions, or none yet.
void RecordedTorque::AddTransmissions(const SimulatedRobot& changed,
                                      const Motion& motion,
                                      std::vector<Deflection> deflections,
                                      MotionTrack* track, MatrixXd* tau) const {
  const bool recorded = &motion == &motion_ && SameLinks(changed.robot, robot_);
  const MatrixXd load = recorded ? load_ : LinkTorque(changed.robot, motion);
  if (deflections.empty()) {
    std::vector<DeflectedJoint> joints;
    for (const Transmission& law : changed.transmissions) {
      joints.push_back(Deflected(law, load));
    }
    deflections = FollowDeflections(joints, motion.dt);
  }
  Motion links = motion;
  for (size_t i = 0; i < deflections.size(); ++i) {
    const int j = changed.transmissions[i].joint;
    links.q.col(j) -= deflections[i].angle;
    links.qd.col(j) -= deflections[i].rate;
    links.qdd.col(j) -= deflections[i].acceleration;
  }
  *tau += LinkTorque(changed.robot, links) - load;
  track->deflection = (motion.q - links.q).transpose();
  track->deflection_rate = (motion.qd - links.qd).transpose();
}

void RecordedTorque::AddLaws(const SimulatedRobot& changed,
                             const MotionTrack& track, MatrixXd* tau) const {
  std::vector<const JointLaw*> laws;
  for (const JointLaw& law : changed.joint_laws) laws.push_back(&law);
  const std::vector<VectorXd> torques = JointLawTorques(laws, track);
  for (size_t i = 0; i < laws.size(); ++i) {
    tau->col(laws[i]->joint) -= torques[i];
  }
  for (const WrenchLaw& law : changed.wrenches) {
    const Attachment& at = law.attachment;
    if (&track != &track_ || !SameLinks(changed.robot, robot_)) {
      TakeWrench(law, track, FollowPoints(changed.robot, track, at).at, tau);
    } else {
      TakeWrench(law, track, PointsOf(at).at, tau);
    }
  }
}

// What the log holds when the motors give what is needed.
MatrixXd RecordedTorque::Recorded(const SimulatedRobot& changed,
                                  const MotionTrack& track,
                                  MatrixXd tau) const {
  if (!changed.actuators.empty()) {
    tau = CommandFor(changed.actuators, track, tau, motion_.torque.tau);
  }
  if (!changed.sensors.empty()) {
    tau = TorqueReadings(changed.sensors, track, tau);
  }
  if (changed.torque_delay != 0) {
    tau += ChangeByDelay(tau, motion_.torque, motion_.dt, changed.torque_delay);
  }
  return tau;
}

// From the motion to the log, slot by slot in the order in which torque flows:
// links, transmissions, laws, actuators, sensors, delay. Where an effect
// changes none of the motion, the nominal torque is used again.
MatrixXd RecordedTorque::ChangeOf(const SimulatedRobot& changed,
                                  const std::vector<Deflection>& deflections) {
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
    tau = Recorded(changed, track_, std::move(tau));
    tau -= nominal_;
    return tau;
  }
  MotionTrack track = track_;
  if (!as_recorded) {
    track.SetMotion(moved);
    track.t = times;
  }
  if (!changed.transmissions.empty()) {
    AddTransmissions(changed, motion, deflections, &track, &tau);
  }
  AddLaws(changed, track, &tau);
  tau = Recorded(changed, track, std::move(tau));
  tau -= nominal_;
  if (changed.clock) AddMadeByClock(changed.clock, &tau);
  return tau;
}

// What drives gave was told from stamps, too.
void RecordedTorque::AddMadeByClock(const std::function<double(double)>& clock,
                                    MatrixXd* tau) const {
  if (motion_.torque_by_rate.size() == 0) return;
  const double h = motion_.dt;
  for (int k = 0; k < motion_.size(); ++k) {
    const double t = motion_.time(k);
    const double rate = (clock(t + h) - clock(t - h)) / (2 * h) - 1;
    tau->row(k) += rate * motion_.torque_by_rate.row(k);
  }
}

// Whether it has joint laws, perhaps in joints that warm up, and nothing else.
bool RecordedTorque::IsOfLawsAlone(const SimulatedRobot& changed) const {
  return changed.num_passive == 0 && changed.transmissions.empty() &&
         changed.wrenches.empty() && changed.actuators.empty() &&
         changed.sensors.empty() && changed.torque_delay == 0 &&
         !changed.clock && changed.clock_unevenness == 0 &&
         SameLinks(changed.robot, robot_) &&
         SameJointTerms(changed.robot, robot_);
}

// Of those (`which`), whose joints warm up alike.
void RecordedTorque::TakeLaws(const std::vector<SimulatedRobot>& changed,
                              const std::vector<size_t>& which,
                              std::vector<OfJoints>* to) {
  std::vector<const JointLaw*> laws;
  std::vector<size_t> of;
  for (const size_t i : which) {
    for (const JointLaw& law : changed[i].joint_laws) {
      laws.push_back(&law);
      of.push_back(i);
    }
  }
  const std::vector<VectorXd> torques = JointLawTorques(laws, track_);
  for (size_t l = 0; l < laws.size(); ++l) {
    VectorXd& joint = (*to)[of[l]][laws[l]->joint];
    if (joint.size() == 0) joint = VectorXd::Zero(motion_.size());
    joint -= torques[l];
  }
  for (const size_t i : which) {
    for (VectorXd& joint : (*to)[i]) {
      if (joint.isZero(0)) joint.resize(0);
    }
  }
}

// Effects of joint laws alone, which most are, are followed together as far as
// their joints warm up alike.
std::vector<RecordedTorque::OfJoints> RecordedTorque::Changes(
    const std::vector<SimulatedRobot>& changed) {
  std::vector<OfJoints> changes(changed.size(), OfJoints(robot_.num_joints()));
  const std::vector<std::vector<Deflection>> deflections =
      DeflectTogether(changed);
  std::vector<size_t> of_laws;
  for (size_t i = 0; i < changed.size(); ++i) {
    if (IsOfLawsAlone(changed[i])) {
      of_laws.push_back(i);
    } else {
      changes[i] = WithoutNothing(ChangeOf(changed[i], deflections[i]));
    }
  }
  while (!of_laws.empty()) {
    const auto& thermal = changed[of_laws[0]].thermal;
    const auto others = std::stable_partition(
        of_laws.begin(), of_laws.end(),
        [&](size_t i) { return SameThermal(changed[i].thermal, thermal); });
    FollowWarmth(thermal);
    TakeLaws(changed, {of_laws.begin(), others}, &changes);
    of_laws.erase(of_laws.begin(), others);
  }
  return changes;
}

MatrixXd RecordedTorque::Change(const SimulatedRobot& changed) {
  const OfJoints joints = std::move(Changes({changed})[0]);
  MatrixXd tau = MatrixXd::Zero(motion_.size(), motion_.num_joints());
  for (int j = 0; j < tau.cols(); ++j) {
    if (joints[j].size() > 0) tau.col(j) = joints[j];
  }
  return tau;
}

}  // namespace armcal
