#pragma once

// Arms in position loops whose commands and positions are logged.

#include <cmath>
#include <map>
#include <random>
#include <string>

#include "calib/closed_loop_replay.h"
#include "calib/torque_information.h"
#include "model/log_writer.h"
#include "model/plant/closed_loop.h"
#include "model/plant/reference_motion.h"
#include "model/plant/simbody_arm.h"
#include "tests/temp_file.h"

namespace armcal {

constexpr double kFrictionWidth = .02;   // rad/s
constexpr double kCommandDelay = .0043;  // s

// Deviation of the noise and step, rad.
struct Encoder {
  double noise, resolution;
};
constexpr Encoder kCoarseEncoder{1e-4, 1e-4};
constexpr Encoder kUsualEncoder{2e-5, 2 * M_PI / (1 << 17)};  // 17 bits

// n links in a row, about horizontal axes that are askew.
inline Robot CommandedTruth(int n) {
  Robot robot;
  for (int j = 0; j < n; ++j) {
    Link link;
    const double share = 1. / (j + 1);
    link.name = "link" + std::to_string(j + 1);
    link.joint.name = "joint" + std::to_string(j + 1);
    const double turn = j == 0 ? .7 : j % 2 ? 1.4 : -1.4;
    link.X_PF.linear() =
        Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitX()).toRotationMatrix();
    if (j > 0) link.X_PF.translation() = Eigen::Vector3d(.3, 0, .05);
    link.inertial = InertialParameters::FromCenterOfMass(
        3 * share, Eigen::Vector3d(.15, .02, .01),
        share * Eigen::Vector3d(.01, .03, .03).asDiagonal().toDenseMatrix());
    link.has_inertial = true;
    link.joint.viscous = .5 * share;
    link.joint.coulomb = .8 * share;
    link.joint.armature = .1 * share;
    robot.links.push_back(link);
  }
  return robot;
}

inline Robot FileOf(Robot robot) {
  for (Link& link : robot.links) {
    link.joint.viscous *= .5;
    link.joint.coulomb *= .3;
    link.joint.armature *= .6;
  }
  return robot;
}

// Simbody's arm under the controller, whose command comes late.
inline CommandedLog RecordCommands(const Robot& truth,
                                   const ControllerOptions& controller,
                                   double duration, Encoder encoder,
                                   int seed = 1) {
  const int n = truth.num_joints();
  SimulatedRobot plant;
  plant.robot = truth;
  for (int j = 0; j < n; ++j) {
    const Joint joint = truth.links[j].joint;
    plant.joint_laws.push_back(
        {j, {}, false, [=](const ArmInstant& at, const double*, double*) {
           const double v = at.velocity[j];
           return -joint.viscous * v -
                  joint.coulomb * std::tanh(v / kFrictionWidth);
         }});
  }
  MotionOptions options;
  options.duration = duration;
  options.seed = 1;
  const ReferenceMotion motion = FourierMotion(truth, options);
  const ReferenceMotion late{
      motion.duration, [&](double t) { return motion.at(t - kCommandDelay); }};
  ClosedLoopOptions loop;
  loop.controller = controller;
  loop.sensors.encoder_noise = Eigen::VectorXd::Constant(n, encoder.noise);
  loop.sensors.encoder_resolution =
      Eigen::VectorXd::Constant(n, encoder.resolution);
  loop.sensors.seed = seed;
  SimbodyArm engine(truth);
  CommandedLog log{"made", {}};
  log.log = RunClosedLoop(plant, truth, late, loop, &engine).log;
  for (int k = 0; k < log.log.size(); ++k) {
    log.log.qref.row(k) = motion.at(log.log.t[k]).q;
  }
  return log;
}

// What such a log's torques say, measured with that noise, N m.
inline TorqueInformation TorquesOf(const CommandedLog& commanded,
                                   const Robot& file, double noise, int seed) {
  Log log = commanded.log;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (double& tau : log.tau.reshaped()) tau += noise * normal(random);
  LogReaderOptions reading;
  reading.joint_names = file.JointNames();
  LogSet logs({WriteFile(LogText(log))}, reading, {});
  return InformByTorques(file, CalibrateLinear(file, {}, &logs, nullptr), {},
                         &logs);
}

inline ControllerOptions CommandedController(const Robot& truth,
                                             double bandwidth_hz = 8) {
  ControllerOptions controller = DefaultController(
      truth, Eigen::VectorXd::Zero(truth.num_joints()), bandwidth_hz);
  controller.feedforward = Feedforward::kNone;
  for (DriveLaw& drive : controller.drives) drive.torque_limit = 1e9;
  return controller;
}

inline std::map<std::string, double> TrueValues(const Robot& robot) {
  std::map<std::string, double> values = {{"drive.delay", kCommandDelay}};
  for (const Link& link : robot.links) {
    values[link.joint.name + ".viscous"] = link.joint.viscous;
    values[link.joint.name + ".coulomb"] = link.joint.coulomb;
    values[link.joint.name + ".armature"] = link.joint.armature;
  }
  return values;
}

}  // namespace armcal
