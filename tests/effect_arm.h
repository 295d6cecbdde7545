#pragma once

#include <random>
#include <string>
#include <vector>

#include "model/effects/effect.h"
#include "model/recorded_torque.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"

namespace armcal {

// A known arm with motors and friction, and what effects need to know of it.
struct EffectArm {
  explicit EffectArm(const std::string& robot_name, double duration = 8,
                     double dt = .01) {
    std::mt19937_64 random(3);
    robot = SampleRobot(robot_name);
    SetRandomInertials(&random, &robot);
    for (Link& link : robot.links) {
      link.joint.armature = .2;
      link.joint.viscous = .8;
      link.joint.coulomb = 1.5;
    }
    const int n = robot.num_joints();
    transitions.assign(n, {CoulombTransition::Law::kVelocity, .02});
    const Log log = RecordMotion(RandomMultisine(&random, n), duration, dt);
    motion.dt = dt;
    motion.q = log.q;
    motion.qd = log.qd;
    motion.qdd = log.qdd;
    // A clock that sways by 10 ms.
    motion.stamp_error = .01 * (2 * M_PI / 6 * log.t.array()).sin();
    SetScale();
  }

  RecordedTorque Recorded() const { return {robot, transitions, motion}; }
  EffectSite Site(int joint) const { return {&robot, joint, &scale}; }

  // The change of recorded torque by the effect at p.
  Eigen::MatrixXd Change(const Effect& effect, int joint,
                         const Eigen::VectorXd& p,
                         RecordedTorque* recorded) const {
    SimulatedRobot changed;
    changed.robot = robot;
    effect.apply(Site(joint), p, &changed);
    return recorded->Change(changed);
  }

  // Every parameter at its size.
  Eigen::VectorXd Sizes(const Effect& effect, int joint) const {
    Eigen::VectorXd p(effect.parameters.size());
    for (int k = 0; k < p.size(); ++k) {
      p[k] = effect.parameters[k].size(Site(joint));
    }
    return p;
  }

  // Joints that can show the effect; -1 of an effect of the whole robot.
  std::vector<int> Joints(const Effect& effect) const {
    std::vector<int> joints;
    const bool whole = effect.scope == Effect::Scope::kRobot;
    for (int j = whole ? -1 : 0; j < (whole ? 0 : robot.num_joints()); ++j) {
      if (!effect.unfit || effect.unfit(Site(j)).empty()) joints.push_back(j);
    }
    return joints;
  }

  void SetScale() {
    const RecordedTorque recorded = Recorded();
    scale.torque = ColumnRms(recorded.nominal());
    scale.top_torque =
        recorded.nominal().cwiseAbs().colwise().maxCoeff().transpose();
    scale.load = ColumnRms(recorded.load());
    scale.speed = ColumnRms(motion.qd);
    scale.top_speed = motion.qd.cwiseAbs().colwise().maxCoeff();
    scale.acceleration = ColumnRms(motion.qdd);
    scale.low = motion.q.colwise().minCoeff();
    scale.high = motion.q.colwise().maxCoeff();
    scale.width = Eigen::VectorXd::Constant(robot.num_joints(), .02);
    scale.begin = motion.t0;
    scale.end = motion.time(motion.size() - 1);
  }

  Robot robot;
  std::vector<CoulombTransition> transitions;
  Motion motion;
  MotionScale scale;
};

}  // namespace armcal
