#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/force_torque/samples.h"
#include "model/robot/inertial_parameters.h"

namespace armcal {

// A rigid load behind a force-torque sensor on the last link.
struct ForceTorqueModel {
  // Unknowns: small rotations of the sensor about L's axes (rad), mass (kg),
  // centre of mass p_LoCm_L (m), inertia about it in L's axes (Ixx, Ixy, Iyy,
  // Ixz, Iyz, Izz, kg m^2), bias (N, N m).
  static constexpr int kRotation = 0, kMass = 3, kCenter = 4, kInertia = 7,
                       kBias = 13, kUnknowns = 19;
  using Jacobian = Eigen::Matrix<double, 6, kUnknowns>;
  using Unknowns = Eigen::Matrix<double, kUnknowns, 1>;

  Eigen::Matrix3d R_LS = Eigen::Matrix3d::Identity();  // sensor's axes in L
  // 1: the sensor reports the force on the load, -1: the force of the load.
  double sign = 1;
  double mass = 0;                                    // kg
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   // p_LoCm_L, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  // I_BBcm_L, kg m^2
  Vector6d bias = Vector6d::Zero();                   // N, N m

  // What the sensor reports, its origin in Lo:
  //   s (R_SL f; R_SL n) + bias, (f, n) by WrenchOf() of the load in L.
  Vector6d Predict(const RigidMotion& motion) const;
  Jacobian Derivatives(const RigidMotion& motion) const;
  // Moved by small steps of the unknowns.
  ForceTorqueModel Moved(const Unknowns& step) const;
};

// A fit of the model, and how well it is known.
struct ForceTorqueFit {
  ForceTorqueModel model;
  Eigen::Matrix<double, 19, 19> covariance =
      Eigen::Matrix<double, 19, 19>::Zero();
  Vector6d noise = Vector6d::Zero();  // of each channel, robust, N and N m
  Vector6d rms = Vector6d::Zero();    // of what is left of each, N and N m
  double cost = 0;  // log likelihood ratios are differences of -cost / 2
};

// Maximum likelihood by Gauss-Newton steps from `start`, each channel weighed
// by its own noise (1.4826 times the median of what is left). Samples in which
// something touches the load pull with a bounded force first (Huber) and with
// none at last (Tukey), by the length of their six residuals.
//
// The inertia about the centre of mass has a prior, N(0, (m r^2)^2) of
// r = 0.1 m for each entry: a motion that turns slowly tells nothing of it.
// The covariance is the sandwich of the information and the scores' long-run
// covariance (ScoreCovariance), as samples' errors follow each other.
ForceTorqueFit FitForceTorque(const ForceTorqueModel& start,
                              const std::vector<ForceTorqueSample>& samples);

// Standard deviation of an inertia's entry by the prior, kg m^2.
double InertiaPrior(double mass);

}  // namespace armcal
