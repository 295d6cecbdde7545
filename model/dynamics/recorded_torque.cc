#include "model/dynamics/recorded_torque.h"

#include <glog/logging.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

#include "model/dynamics/actuator_inversion.h"
#include "model/dynamics/joint_law_torques.h"
#include "model/dynamics/motion_behind_readings.h"
#include "model/signals/recording_delay.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool SameThermal(const std::vector<JointThermal>& a,
                 const std::vector<JointThermal>& b) {
  if (a.size() != b.size()) return false;
  const auto same = [](const JointThermal& x, const JointThermal& y) {
    return x.capacity == y.capacity && x.resistance == y.resistance &&
           x.viscous_fall == y.viscous_fall && x.coulomb_fall == y.coulomb_fall;
  };
  return std::equal(a.begin(), a.end(), b.begin(), same);
}

RecordedTorque::OfJoints WithoutNothing(const MatrixXd& tau) {
  RecordedTorque::OfJoints joints(tau.cols());
  for (Eigen::Index j = 0; j < tau.cols(); ++j) {
    if (!tau.col(j).isZero(0)) joints[j] = tau.col(j);
  }
  return joints;
}

// Whether encoders and stamps say where and when the motors were.
bool MotorsMoveAsRecorded(const SimulatedRobot& changed) {
  return changed.sensors.empty() && !changed.clock &&
         changed.clock_unevenness == 0;
}

bool HaveLawsThatSeeLinks(const SimulatedRobot& changed) {
  return std::any_of(changed.joint_laws.begin(), changed.joint_laws.end(),
                     [](const JointLaw& law) { return law.sees_link; });
}

// Whether its laws see the recorded motion: its links move with its motors, or
// no law looks at links.
bool SeesRecordedMotion(const SimulatedRobot& changed) {
  return MotorsMoveAsRecorded(changed) &&
         (changed.transmissions.empty() || !HaveLawsThatSeeLinks(changed));
}

// Whether there is a slot to which links that move otherwise make a difference.
// Wrenches act where the motors have the arm (wrench_torque.h).
bool LooksAtLinks(const SimulatedRobot& changed) {
  return HaveLawsThatSeeLinks(changed) || !changed.actuators.empty() ||
         !changed.sensors.empty();
}

std::vector<const JointLaw*> PointersTo(const SimulatedRobot& changed) {
  std::vector<const JointLaw*> laws;
  for (const JointLaw& law : changed.joint_laws) laws.push_back(&law);
  return laws;
}

void TakeTorques(const std::vector<JointLaw>& laws,
                 const std::vector<VectorXd>& torques, MatrixXd* tau) {
  for (size_t i = 0; i < laws.size(); ++i) {
    tau->col(laws[i].joint) -= torques[i];
  }
}

// The same of n joints on which nothing else acts.
RecordedTorque::OfJoints TakenByJoints(const std::vector<JointLaw>& laws,
                                       const std::vector<VectorXd>& torques,
                                       int n) {
  RecordedTorque::OfJoints joints(n);
  for (size_t i = 0; i < laws.size(); ++i) {
    VectorXd& joint = joints[laws[i].joint];
    if (joint.size() == 0) joint = VectorXd::Zero(torques[i].size());
    joint -= torques[i];
  }
  for (VectorXd& joint : joints) {
    if (joint.isZero(0)) joint.resize(0);
  }
  return joints;
}

// Whether it differs from a robot by transmissions and by laws that do not see
// them, perhaps in joints that warm up, and by nothing else.
bool IsOfDrivesAlone(const SimulatedRobot& changed, const Robot& robot) {
  return SeesRecordedMotion(changed) && changed.num_passive == 0 &&
         changed.wrenches.empty() && changed.actuators.empty() &&
         changed.torque_delay == 0 && SameLinks(changed.robot, robot) &&
         SameJointTerms(changed.robot, robot);
}

// What only links behind transmissions and laws add to a nominal torque, joint
// by joint.
RecordedTorque::OfJoints ChangedByDrives(const MatrixXd& nominal,
                                         const DeflectedLinks& links,
                                         const std::vector<JointLaw>& laws,
                                         const std::vector<VectorXd>& torques) {
  RecordedTorque::OfJoints joints(nominal.cols());
  VectorXd tau;
  for (Eigen::Index j = 0; j < nominal.cols(); ++j) {
    tau = nominal.col(j) + links.change.col(j);
    for (size_t i = 0; i < laws.size(); ++i) {
      if (laws[i].joint == j) tau -= torques[i];
    }
    tau -= nominal.col(j);
    if (!tau.isZero(0)) joints[j] = tau;
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
  friction_power_ = {motion_.qd.cwiseAbs2(), coulomb_.cwiseProduct(motion_.qd)};
  for (int j = 0; j < n; ++j) {
    friction_power_.viscous.col(j) *= robot_.links[j].joint.viscous;
    friction_power_.coulomb.col(j) *= robot_.links[j].joint.coulomb;
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

// Links, whose torque is `load`, and joint terms of a changed robot, or along
// another motion.
MatrixXd RecordedTorque::RigidTorque(const Robot& robot, const Motion& motion,
                                     const MatrixXd& load,
                                     bool as_recorded) const {
  MatrixXd tau = load;
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

std::vector<RecordedTorque::Links> RecordedTorque::FollowTransmissions(
    const std::vector<SimulatedRobot>& changed, LinkTorques* loads) const {
  std::vector<LinksBehindDrives> arms;
  std::vector<size_t> of;
  for (size_t i = 0; i < changed.size(); ++i) {
    const SimulatedRobot& one = changed[i];
    if (one.transmissions.empty() || !MotorsMoveAsRecorded(one)) continue;
    arms.push_back({&one.robot, &one.transmissions, &loads->Of(one.robot)});
    of.push_back(i);
  }
  std::vector<Links> links(changed.size());
  if (arms.empty()) return links;
  const auto followed = FollowLinks(arms, motion_, Slopes());
  for (size_t k = 0; k < arms.size(); ++k) links[of[k]] = followed[k];
  return links;
}

void RecordedTorque::AddWrenches(const SimulatedRobot& changed,
                                 const MotionTrack& track,
                                 MatrixXd* tau) const {
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
    MatrixXd given = tau;
    if (beyond_nominal_.size() > 0) given += beyond_nominal_;
    tau +=
        ChangeByDelay(given, motion_.torque, motion_.dt, changed.torque_delay);
  }
  return tau;
}

// From the motion to the log, slot by slot in the order in which torque flows:
// links, transmissions, laws, actuators, sensors, delay. Where an effect
// changes none of the motion, the nominal torque is used again.
MatrixXd RecordedTorque::ChangeOf(const SimulatedRobot& changed,
                                  const Shared& shared) {
  CHECK_EQ(changed.robot.num_joints(), robot_.num_joints());
  CHECK_EQ(changed.num_passive, 0);
  Motion moved;
  VectorXd times;
  const bool as_recorded =
      !MotionBehindReadings(changed, motion_, track_, &moved, &times);
  const Motion& motion = as_recorded ? motion_ : moved;
  const MatrixXd of_moved =
      as_recorded ? MatrixXd() : LinkTorque(changed.robot, moved);
  const MatrixXd& load =
      as_recorded ? shared.loads->Of(changed.robot) : of_moved;
  MatrixXd tau = &load == &load_ && SameJointTerms(changed.robot, robot_)
                     ? nominal_
                     : RigidTorque(changed.robot, motion, load, as_recorded);
  auto links = shared.links;
  // A motion behind readings is close to the recorded one, of which the slopes
  // are.
  if (!changed.transmissions.empty() && !links) {
    links = FollowLinks({{&changed.robot, &changed.transmissions, &load}},
                        motion, Slopes())[0];
  }
  if (links) tau += links->change;
  MotionTrack other;
  const bool as_tracked = as_recorded && (!links || !LooksAtLinks(changed));
  if (!as_tracked) other = TrackOf(motion, times, links.get());
  const MotionTrack& track = as_tracked ? track_ : other;
  std::vector<VectorXd> own;
  if (shared.laws.empty()) own = JointLawTorques(PointersTo(changed), track);
  TakeTorques(changed.joint_laws, shared.laws.empty() ? own : shared.laws,
              &tau);
  AddWrenches(changed, track, &tau);
  tau = Recorded(changed, track, std::move(tau));
  tau -= nominal_;
  if (changed.clock) AddMadeByClock(changed.clock, &tau);
  return tau;
}

// What laws see where the motors move like this, at these times (empty: as
// recorded), and these links behind them (nullptr: with them).
MotionTrack RecordedTorque::TrackOf(const Motion& motion, const VectorXd& times,
                                    const DeflectedLinks* links) const {
  MotionTrack track = track_;
  if (&motion != &motion_) {
    track.SetMotion(motion);
    track.t = times;
  }
  if (links != nullptr) {
    track.deflection = track.deflection_rate =
        MatrixXd::Zero(track.num_joints(), track.size());
    for (size_t i = 0; i < links->joints.size(); ++i) {
      const int j = links->joints[i];
      track.deflection.row(j) += links->deflections[i].angle;
      track.deflection_rate.row(j) += links->deflections[i].rate;
    }
  }
  return track;
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
  return changed.transmissions.empty() && IsOfDrivesAlone(changed, robot_);
}

// Of those (`which`), whose joints warm up alike. Joint laws that see the
// recorded motion go along it together, be there other slots or not.
void RecordedTorque::AddChanges(const std::vector<SimulatedRobot>& changed,
                                const std::vector<size_t>& which,
                                const std::vector<Links>& links,
                                LinkTorques* loads, std::vector<OfJoints>* to) {
  std::vector<const JointLaw*> laws;
  for (const size_t i : which) {
    if (!SeesRecordedMotion(changed[i])) continue;
    for (const JointLaw& law : changed[i].joint_laws) laws.push_back(&law);
  }
  std::vector<VectorXd> torques = JointLawTorques(laws, track_);
  auto next = std::make_move_iterator(torques.begin());
  for (const size_t i : which) {
    const SimulatedRobot& one = changed[i];
    Shared shared = {loads, links[i], {}};
    if (SeesRecordedMotion(one)) {
      const auto end = next + static_cast<long>(one.joint_laws.size());
      shared.laws.assign(next, end);
      next = end;
    }
    if (IsOfLawsAlone(one)) {
      (*to)[i] =
          TakenByJoints(one.joint_laws, shared.laws, robot_.num_joints());
    } else if (IsOfDrivesAlone(one, robot_)) {
      (*to)[i] =
          ChangedByDrives(nominal_, *shared.links, one.joint_laws, shared.laws);
    } else {
      (*to)[i] = WithoutNothing(ChangeOf(one, shared));
    }
  }
}

std::vector<RecordedTorque::OfJoints> RecordedTorque::Changes(
    const std::vector<SimulatedRobot>& changed) {
  std::vector<OfJoints> changes(changed.size());
  LinkTorques loads(robot_, load_, motion_);
  const std::vector<Links> links = FollowTransmissions(changed, &loads);
  std::vector<size_t> left(changed.size());
  std::iota(left.begin(), left.end(), size_t{0});
  while (!left.empty()) {
    const auto& thermal = changed[left[0]].thermal;
    const auto others = std::stable_partition(
        left.begin(), left.end(),
        [&](size_t i) { return SameThermal(changed[i].thermal, thermal); });
    FollowWarmth(thermal);
    AddChanges(changed, {left.begin(), others}, links, &loads, &changes);
    left.erase(left.begin(), others);
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
