#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

namespace armcal {

using Vector10d = Eigen::Matrix<double, 10, 1>;

// The ten inertial parameters of a rigid body B about the origin Bo of its
// frame, expressed in B.
struct InertialParameters {
  double mass = 0;                                         // kg
  Eigen::Vector3d first_moment = Eigen::Vector3d::Zero();  // h = m p_BoBcm_B
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();       // I_BBo_B, kg m^2

  // m, hx, hy, hz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz (Pinocchio's order).
  Vector10d ToVector() const;
  static InertialParameters FromVector(const Vector10d& v);

  // From the mass (kg), the centre of mass p_BoBcm_B (m) and the inertia about
  // the centre of mass, axes parallel to B (kg m^2).
  static InertialParameters FromCenterOfMass(
      double mass, const Eigen::Vector3d& com,
      const Eigen::Matrix3d& inertia_about_com);

  // The same body about Ao, expressed in A; X_AB is the pose of B in A.
  InertialParameters ReexpressIn(const Eigen::Isometry3d& X_AB) const;

  InertialParameters& operator+=(const InertialParameters& other);
};

// Names and units of ToVector()'s entries: "mass", "hx", ..., "Izz".
const char* InertialName(int index);
const char* InertialUnit(int index);

// The second moments of mass, the integral of (p; 1) (p; 1)' dm over the body,
//   [ tr(I)/2 1 - I   h ]
//   [ h'              m ],
// kg m^2, kg m, kg: linear in the parameters V of ToVector(), and positive
// semidefinite for every body that can exist (Wensing, Kim, Slotine 2018).
Eigen::Matrix4d PseudoInertia(const Vector10d& V);

// An empty text where a rigid body with these parameters can exist (mass > 0,
// and the inertia about the centre of mass positive semidefinite with its
// principal moments meeting the triangle inequality, within 1e-9 relative);
// otherwise which rule is broken, with the values.
std::string WhyUnphysical(const InertialParameters& parameters);

}  // namespace armcal
