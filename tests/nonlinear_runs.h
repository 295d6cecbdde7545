#pragma once

// Simulated arms whose links differ from their robot file's, and what
// CalibrateNonlinear makes of their logs.

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "calib/linear_calibration.h"
#include "calib/nonlinear_calibration.h"
#include "problems/inertial_coordinates.h"
#include "tests/sample_motion.h"
#include "tests/sample_robots.h"
#include "tests/temp_file.h"

namespace armcal {

// A rigid body drawn from the prior: the pseudo-inertia's relative deviation
// is normal in every direction, and the body can exist.
inline InertialParameters DrawAround(const InertialParameters& file,
                                     double trust, std::mt19937_64* random) {
  const Eigen::Matrix4d A = PseudoInertia(file.ToVector()).llt().matrixL();
  for (;;) {
    Eigen::Matrix4d E;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j <= i; ++j) {
        E(i, j) = E(j, i) =
            trust * Normal(random) * (i == j ? 1 : std::sqrt(.5));
      }
    }
    const Eigen::Matrix4d relative = Eigen::Matrix4d::Identity() + E;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(relative);
    if (eigen.eigenvalues()[0] < .02) continue;
    const Eigen::Matrix4d P = A * relative * A.transpose();
    const Eigen::Matrix3d S = P.topLeftCorner<3, 3>();
    InertialParameters body;
    body.mass = P(3, 3);
    body.first_moment = P.topRightCorner<3, 1>();
    body.inertia = S.trace() * Eigen::Matrix3d::Identity() - S;
    return body;
  }
}

struct SimulatedArm {
  Robot file, truth;
};

// `trust`: how far the truth is from the file. The file knows no joint terms.
inline SimulatedArm MakeArm(const std::string& name, double trust,
                            std::mt19937_64* random) {
  SimulatedArm arm{SampleRobot(name), {}};
  SetRandomInertials(random, &arm.file);
  arm.truth = arm.file;
  for (Link& link : arm.truth.links) {
    link.inertial = DrawAround(link.inertial, trust, random);
    link.joint.viscous = Uniform(random, .5, 2);
    link.joint.coulomb = Uniform(random, .5, 2);
    link.joint.armature = Uniform(random, .1, .5);
    link.joint.offset = Uniform(random, -.5, .5);
  }
  return arm;
}

constexpr CoulombTransition kTransition = {
    CoulombTransition::Law::kDisplacement, .003};

// A log of random motion, without noise.
inline Log MoveArm(const Robot& truth, double duration,
                   std::mt19937_64* random) {
  Log log = RecordMotion(RandomMultisine(random, truth.num_joints(), 1.2),
                         duration, .01);
  AddTorque(truth, &log);
  for (int j = 0; j < truth.num_joints(); ++j) {
    AddCoulomb(j, truth.links[j].joint.coulomb, kTransition, &log);
    log.tau.col(j).array() += truth.links[j].joint.offset;
  }
  return log;
}

struct NonlinearRun {
  LinearCalibration linear;
  NonlinearCalibration physical;
  std::string held_out;  // path of the log it was validated on
};

// Calibrates on one log and validates on another, both with noise of `noise`
// times the torque unless the validation log's is given.
inline NonlinearRun Calibrate(
    const SimulatedArm& arm, double noise,
    const NonlinearCalibrationOptions& options, std::mt19937_64* random,
    GeometryKnowledge geometry = GeometryKnowledge::kKnown,
    std::optional<double> validation_noise = {}) {
  LogReaderOptions reader;
  reader.joint_names = arm.file.JointNames();
  const auto write = [&](double duration, double size,
                         const std::string& name) {
    Log log = MoveArm(arm.truth, duration, random);
    AddNoise(random, size * ColumnRms(log.tau), &log.tau);
    return WriteFile(LogCsv(log), name);
  };
  LogSet training({write(30, noise, "training.csv")}, reader, {});
  const std::string held_out =
      write(10, validation_noise.value_or(noise), "validation.csv");
  LogSet validation({held_out}, reader, {});
  LinearCalibrationOptions linear;
  linear.geometry = geometry;
  linear.transition = kTransition;
  linear.bandwidth_hz = 0;
  LinearCalibration start =
      CalibrateLinear(arm.file, linear, &training, &validation);
  NonlinearCalibration physical =
      CalibrateNonlinear(arm.file, start, options, &training, &validation);
  return {std::move(start), std::move(physical), held_out};
}

// The value of a parameter in `robot`: "<link>.mass", "<joint>.viscous".
inline double ValueIn(const Robot& robot, const std::string& name) {
  for (const Link& link : robot.links) {
    const Joint& joint = link.joint;
    for (int k = 0; k < 10; ++k) {
      if (name == link.name + "." + InertialName(k)) {
        return link.inertial.ToVector()[k];
      }
    }
    if (name == joint.name + ".viscous") return joint.viscous;
    if (name == joint.name + ".coulomb") return joint.coulomb;
    if (name == joint.name + ".armature") return joint.armature;
    if (name == joint.name + ".offset") return joint.offset;
  }
  ADD_FAILURE() << "no parameter " << name;
  return std::nan("");
}

}  // namespace armcal
