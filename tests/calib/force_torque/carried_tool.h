#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>

#include "calib/force_torque/sensor.h"
#include "model/plant/simbody_arm.h"
#include "model/robot/rotations.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal {

// A tool behind a force-torque sensor on the last link, and what is wrong with
// the sensor.
struct CarriedTool {
  ForceTorqueModel truth;
  Vector6d noise = Vector6d::Constant(.01);  // N m
  double correlation = 0;  // of the noise, from a sample to the next

  static CarriedTool Random(std::mt19937_64* random) {
    CarriedTool tool;
    ForceTorqueModel& truth = tool.truth;
    truth.mass = Uniform(random, .8, 3);
    truth.center = UniformVector(random, 3, -.1, .1);
    const double radius = Uniform(random, .03, .06);  // m, a ball's of gyration
    truth.inertia = truth.mass * radius * radius * Eigen::Matrix3d::Identity();
    truth.bias << UniformVector(random, 3, -20, 20),
        UniformVector(random, 3, -1, 1);
    const Eigen::Vector3d axis = UniformVector(random, 3, -1, 1);
    truth.R_LS = Eigen::AngleAxisd(Uniform(random, -3, 3), axis.normalized());
    tool.noise.head<3>().setConstant(.2);  // N
    return tool;
  }
};

// Simbody's reaction between the last link and the tool, which is a link of its
// own behind a joint that rests: in the sensor's axes, about the last link's
// origin, with bias and noise.
inline void AddWrench(const Robot& robot, const CarriedTool& tool,
                      std::mt19937_64* random, Log* log) {
  const ForceTorqueModel& truth = tool.truth;
  const Eigen::Matrix3d R_SL = truth.R_LS.transpose();
  Robot carrying = robot;
  Link link;
  link.name = "tool";
  link.joint.name = "mount";
  link.X_PF.linear() = truth.R_LS;
  link.inertial = InertialParameters::FromCenterOfMass(
      truth.mass, R_SL * truth.center, R_SL * truth.inertia * truth.R_LS);
  carrying.links.push_back(link);
  SimbodyArm arm(carrying);
  const auto with_tool = [](const Eigen::VectorXd& x) {
    Eigen::VectorXd longer = Eigen::VectorXd::Zero(x.size() + 1);
    longer.head(x.size()) = x;
    return longer;
  };
  log->wrench.resize(log->size(), 6);
  Vector6d error = Vector6d::Zero();
  const double fresh = std::sqrt(1 - tool.correlation * tool.correlation);
  for (int k = 0; k < log->size(); ++k) {
    for (int c = 0; c < 6; ++c) {
      error[c] = tool.correlation * error[c] +
                 (k == 0 ? 1 : fresh) * tool.noise[c] * Normal(random);
    }
    log->wrench.row(k) =
        (truth.sign * arm.LastReaction(with_tool(log->q.row(k).transpose()),
                                       with_tool(log->qd.row(k).transpose()),
                                       with_tool(log->qdd.row(k).transpose())) +
         truth.bias + error)
            .transpose();
  }
}

// As a log's file gives them, low-passed at 10 Hz.
inline std::vector<ForceTorqueSample> SamplesOf(const Robot& robot, Log log) {
  log.qd.resize(0, 0);
  log.qdd.resize(0, 0);
  log.tau.setZero(log.size(), robot.num_joints());
  LogReaderOptions reading;
  reading.joint_names = robot.JointNames();
  reading.want_wrench = true;
  const LogSet logs({LogSource("log", log)}, reading, TimeRange());
  PreparationOptions preparation;
  preparation.bandwidth_hz = 10;
  return GatherForceTorque(robot, {}, Prepare(logs, preparation));
}

// How far an estimate's unknowns are from the truth; the rotation as a small
// one in L.
inline ForceTorqueModel::Unknowns ErrorsOf(const ForceTorqueModel& estimate,
                                           const ForceTorqueModel& truth) {
  using Model = ForceTorqueModel;
  Model::Unknowns error;
  const Eigen::AngleAxisd turn(estimate.R_LS * truth.R_LS.transpose());
  error.segment<3>(Model::kRotation) = turn.angle() * turn.axis();
  error[Model::kMass] = estimate.mass - truth.mass;
  error.segment<3>(Model::kCenter) = estimate.center - truth.center;
  InertialParameters wrong;
  wrong.inertia = estimate.inertia - truth.inertia;
  error.segment<6>(Model::kInertia) = wrong.ToVector().tail<6>();
  error.segment<6>(Model::kBias) = estimate.bias - truth.bias;
  return error;
}

}  // namespace armcal
