#include "model/robot/inertial_parameters.h"

#include <glog/logging.h>

#include <Eigen/Eigenvalues>

#include "model/text/input_text.h"

namespace armcal {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// [a]x [b]x transposed and made symmetric: the inertia of a mass moment b with
// its arm a is a.b 1 - (a b' + b a') / 2.
Matrix3d ShiftTerm(const Vector3d& a, const Vector3d& b) {
  return a.dot(b) * Matrix3d::Identity() -
         (a * b.transpose() + b * a.transpose()) / 2;
}

std::string Moments(const Vector3d& moments) {
  return "principal moments about the centre of mass " +
         NumberText(moments[0]) + ", " + NumberText(moments[1]) + ", " +
         NumberText(moments[2]) + " kg m^2";
}

}  // namespace

Vector10d InertialParameters::ToVector() const {
  Vector10d v;
  v << mass, first_moment, inertia(0, 0), inertia(0, 1), inertia(1, 1),
      inertia(0, 2), inertia(1, 2), inertia(2, 2);
  return v;
}

InertialParameters InertialParameters::FromVector(const Vector10d& v) {
  InertialParameters result;
  result.mass = v[0];
  result.first_moment = v.segment<3>(1);
  result.inertia << v[4], v[5], v[7],  //
      v[5], v[6], v[8],                //
      v[7], v[8], v[9];
  return result;
}

InertialParameters InertialParameters::FromCenterOfMass(
    double mass, const Vector3d& com, const Matrix3d& inertia_about_com) {
  InertialParameters result;
  result.mass = mass;
  result.first_moment = mass * com;
  // Steiner: I_BBo = I_BBcm + m (c.c 1 - c c').
  result.inertia = inertia_about_com + ShiftTerm(com, mass * com);
  return result;
}

// With p = p_AoBo_A and h the first moment turned into A:
//   h_A = h + m p,   I_A = R I R' + 2 S(p, h) + m S(p, p),
// which needs no centre of mass and so holds for massless parameters too.
InertialParameters InertialParameters::ReexpressIn(
    const Eigen::Isometry3d& X_AB) const {
  const Matrix3d R = X_AB.linear();
  const Vector3d p = X_AB.translation();
  const Vector3d h = R * first_moment;
  InertialParameters result;
  result.mass = mass;
  result.first_moment = h + mass * p;
  result.inertia = R * inertia * R.transpose() + 2 * ShiftTerm(p, h) +
                   mass * ShiftTerm(p, p);
  return result;
}

InertialParameters& InertialParameters::operator+=(
    const InertialParameters& other) {
  mass += other.mass;
  first_moment += other.first_moment;
  inertia += other.inertia;
  return *this;
}

const char* InertialName(int index) {
  static constexpr const char* kNames[] = {"mass", "hx",  "hy",  "hz",  "Ixx",
                                           "Ixy",  "Iyy", "Ixz", "Iyz", "Izz"};
  CHECK(index >= 0 && index < 10) << index;
  return kNames[index];
}

const char* InertialUnit(int index) {
  CHECK(index >= 0 && index < 10) << index;
  return index == 0 ? "kg" : index < 4 ? "kg m" : "kg m^2";
}

Eigen::Matrix4d PseudoInertia(const Vector10d& V) {
  const auto inertial = InertialParameters::FromVector(V);
  const Matrix3d& I = inertial.inertia;
  Eigen::Matrix4d P;
  P << I.trace() / 2 * Matrix3d::Identity() - I, inertial.first_moment,
      inertial.first_moment.transpose(), inertial.mass;
  return P;
}

std::string WhyUnphysical(const InertialParameters& parameters) {
  if (!parameters.ToVector().allFinite()) return "a parameter is not finite";
  if (!(parameters.mass > 0)) {
    return "mass " + NumberText(parameters.mass) + " kg is not positive";
  }
  const Vector3d com = parameters.first_moment / parameters.mass;
  const Matrix3d about_com =
      parameters.inertia - ShiftTerm(com, parameters.first_moment);
  if (!about_com.allFinite()) {
    return "mass " + NumberText(parameters.mass) +
           " kg is too small for its first moment";
  }
  const Vector3d moments =  // in increasing order
      Eigen::SelfAdjointEigenSolver<Matrix3d>(about_com, Eigen::EigenvaluesOnly)
          .eigenvalues();
  // The difference above cannot be more exact than the terms it is made of.
  const double tolerance = 1e-9 * parameters.inertia.trace();
  if (moments[0] < -tolerance) {
    return Moments(moments) + " are not all positive";
  }
  if (moments[0] + moments[1] < moments[2] - tolerance) {
    return Moments(moments) + " break the triangle inequality";
  }
  return "";
}

}  // namespace armcal
