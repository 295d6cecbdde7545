#include "model/plant/robot_variation.h"

#include <Eigen/Eigenvalues>
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

// The Frobenius-nearest whose second moments about the centre of mass are at
// least a thousandth of the largest, so that it is not flat either.
InertialParameters NearestPossible(const InertialParameters& inertial) {
  constexpr double kLeast = 1e-3;
  const Eigen::Matrix4d J = PseudoInertia(inertial.ToVector());
  const Eigen::Vector3d com = inertial.first_moment / inertial.mass;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> moments(
      J.topLeftCorner<3, 3>() - inertial.mass * com * com.transpose());
  const Eigen::Vector3d values = moments.eigenvalues();
  const Eigen::Vector3d possible = values.cwiseMax(kLeast * values[2]);
  Eigen::Matrix4d nearest = J;
  nearest.topLeftCorner<3, 3>() = moments.eigenvectors() *
                                      possible.asDiagonal() *
                                      moments.eigenvectors().transpose() +
                                  inertial.mass * com * com.transpose();
  return FromPseudoInertia(nearest);
}

}  // namespace

std::vector<std::string> MakeLinksPossible(Robot* robot) {
  std::vector<std::string> changed;
  for (Link& link : robot->links) {
    if (!(link.inertial.mass > 0) || WhyUnphysical(link.inertial).empty()) {
      continue;
    }
    link.inertial = NearestPossible(link.inertial);
    if (WhyUnphysical(link.inertial).empty()) changed.push_back(link.name);
  }
  return changed;
}

Robot VaryRobot(const Robot& robot, double share, uint64_t seed) {
  std::mt19937_64 random = RandomStream(seed, 0, RandomPurpose::kRobot);
  // Scaled, since a normal_distribution of no deviation is not defined.
  std::normal_distribution<double> normal;
  const auto error = [&] { return share * normal(random); };
  const auto factor = [&] { return std::exp(error()); };
  Robot varied = robot;
  MakeLinksPossible(&varied);
  for (Link& link : varied.links) {
    // About the centre of mass, so that `share` is of the body's own size: a
    // body far from its link's origin is not moved far.
    Eigen::Matrix4d A = Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) A(i, j) += error() / 2;
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
