#pragma once

#include <cmath>
#include <random>

#include "calib/watch/model.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {

// An elbow arm with bodies, friction and armature.
inline Robot WatchedRobot() {
  std::mt19937_64 random(3);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) {
    link.has_inertial = true;
    link.joint.viscous = 1;
    link.joint.coulomb = 1.5;
    link.joint.armature = .3;
  }
  return robot;
}

constexpr double kWatchedNoise = .1;  // N m, of every sample of the torque

// What a calibration of it would know: itself, to 1 % of each parameter's size.
inline WatchModel WatchedModel(const Robot& robot) {
  ModelParameters::Options options;
  options.joint_terms = {JointTerm::kViscous, JointTerm::kCoulomb,
                         JointTerm::kOffset, JointTerm::kArmature};
  const CoulombTransition law{CoulombTransition::Law::kVelocity, .05};
  options.transitions.assign(robot.num_joints(), {law});
  WatchModel model{robot, ModelParameters(robot, options), {}, {}, {}, {}};
  model.x = model.parameters.Values(robot);
  const Eigen::VectorXd stddev =
      (.01 * model.x.cwiseAbs()).cwiseMax(1e-3).matrix();
  model.covariance = stddev.cwiseAbs2().asDiagonal();
  model.residual_rms =
      Eigen::VectorXd::Constant(robot.num_joints(), kWatchedNoise / 5);
  model.torque_rms = Eigen::VectorXd::Constant(robot.num_joints(), 20);
  return model;
}

// The same motion for the same seed, with the torque of `robot` and noise.
inline Log WatchedLog(const Robot& robot, int seed, double seconds,
                      double noise = kWatchedNoise) {
  std::mt19937_64 random(seed);
  const int n = robot.num_joints();
  Log log = RecordMotion(RandomMultisine(&random, n), seconds, .001);
  AddTorque(robot, &log);
  for (int j = 0; j < n; ++j) {
    AddCoulomb(j, robot.links[j].joint.coulomb,
               {CoulombTransition::Law::kVelocity, .05}, &log);
  }
  AddNoise(&random, Eigen::VectorXd::Constant(n, noise), &log.tau);
  return log;
}

}  // namespace armcal
