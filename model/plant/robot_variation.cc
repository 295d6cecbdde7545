#include "model/plant/robot_variation.h"

#include <cmath>
#include <random>

#include "model/plant/random_stream.h"

namespace armcal {

namespace {

InertialParameters FromPseudoInertia(const Eigen::Matrix4d& J) {
  InertialParameters inertial;
  const Eigen::Matrix3d second = J.topLeftCorner<3, 3>();
  inertial.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
  inertial.first_moment = J.topRightCorner<3, 1>();
  inertial.mass = J(3, 3);
  return inertial;
}

}  // namespace

Robot VaryRobot(const Robot& robot, double share, uint64_t seed) {
  std::mt19937_64 random = RandomStream(seed, 0, RandomPurpose::kRobot);
  std::normal_distribution<double> normal(0, share);
  const auto factor = [&] { return std::exp(normal(random)); };
  Robot varied = robot;
  for (Link& link : varied.links) {
    // About the centre of mass, so that `share` is of the body's own size: a
    // body far from its link's origin is not moved far.
    Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) A(i, j) += normal(random) / 2;
    }
    const double mass_factor = factor();
    const double lever_factor = factor();
    if (link.inertial.mass > 0) {
      Eigen::Matrix4d X = Eigen::Matrix4d::Identity();
      X.topRightCorner<3, 1>() =
          link.inertial.first_moment / link.inertial.mass;
      Eigen::Matrix4d moved = X;
      moved.topRightCorner<3, 1>() *= lever_factor;
      const Eigen::Matrix4d T = moved * A * X.inverse();
      link.inertial = FromPseudoInertia(
          mass_factor * T * PseudoInertia(link.inertial.ToVector()) *
          T.transpose());
    }
    link.joint.armature *= factor();
    link.joint.viscous *= factor();
    link.joint.coulomb *= factor();
  }
  return varied;
}

}  // namespace armcal
