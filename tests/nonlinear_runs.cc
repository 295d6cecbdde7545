#include "tests/nonlinear_runs.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "problems/inertial_coordinates.h"
#include "tests/temp_file.h"

namespace armcal {

InertialParameters DrawAround(const InertialParameters& file, double trust,
                              std::mt19937_64* random) {
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

SimulatedArm MakeArm(const std::string& name, double trust,
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

Log MoveArm(const Robot& truth, double duration, std::mt19937_64* random) {
  Log log = RecordMotion(RandomMultisine(random, truth.num_joints(), 1.2),
                         duration, .01);
  AddTorque(truth, &log);
  for (int j = 0; j < truth.num_joints(); ++j) {
    AddCoulomb(j, truth.links[j].joint.coulomb, kTransition, &log);
    log.tau.col(j).array() += truth.links[j].joint.offset;
  }
  return log;
}

NonlinearRun Calibrate(const SimulatedArm& arm, double noise,
                       const NonlinearCalibrationOptions& options,
                       std::mt19937_64* random, GeometryKnowledge geometry,
                       std::optional<double> validation_noise) {
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

double ValueIn(const Robot& robot, const std::string& name) {
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
