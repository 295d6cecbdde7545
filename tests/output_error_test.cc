#include "calib/output_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "calib/loop_noise.h"
#include "model/plant/closed_loop.h"
#include "model/plant/reference_motion.h"
#include "model/plant/simbody_arm.h"

namespace armcal {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kWidth = .02;  // rad/s
constexpr double kDelay = .0043;
constexpr double kNoise = 1e-4;  // rad

// n links in a row, about horizontal axes that are askew.
Robot Truth(int n) {
  Robot robot;
  for (int j = 0; j < n; ++j) {
    Link link;
    const double share = 1. / (j + 1);
    link.name = "link" + std::to_string(j + 1);
    link.joint.name = "joint" + std::to_string(j + 1);
    const double turn = j == 0 ? .7 : j % 2 ? 1.4 : -1.4;
    link.X_PF.linear() =
        Eigen::AngleAxisd(turn, Vector3d::UnitX()).toRotationMatrix();
    if (j > 0) link.X_PF.translation() = Vector3d(.3, 0, .05);
    link.inertial = InertialParameters::FromCenterOfMass(
        3 * share, Vector3d(.15, .02, .01),
        share * Vector3d(.01, .03, .03).asDiagonal().toDenseMatrix());
    link.has_inertial = true;
    link.joint.viscous = .5 * share;
    link.joint.coulomb = .8 * share;
    link.joint.armature = .1 * share;
    robot.links.push_back(link);
  }
  return robot;
}

Robot File(Robot robot) {
  for (Link& link : robot.links) {
    link.joint.viscous *= .5;
    link.joint.coulomb *= .3;
    link.joint.armature *= .6;
  }
  return robot;
}

// Simbody's arm under the controller, whose command comes late.
CommandedLog Record(const Robot& truth, const ControllerOptions& controller,
                    double duration, double noise) {
  const int n = truth.num_joints();
  SimulatedRobot plant;
  plant.robot = truth;
  for (int j = 0; j < n; ++j) {
    const Joint joint = truth.links[j].joint;
    plant.joint_laws.push_back(
        {j, {}, false, [=](const ArmInstant& at, const double*, double*) {
           const double v = at.velocity[j];
           return -joint.viscous * v - joint.coulomb * std::tanh(v / kWidth);
         }});
  }
  MotionOptions options;
  options.duration = duration;
  options.seed = 1;
  const ReferenceMotion motion = FourierMotion(truth, options);
  const ReferenceMotion late{motion.duration,
                             [&](double t) { return motion.at(t - kDelay); }};
  ClosedLoopOptions loop;
  loop.controller = controller;
  loop.sensors.encoder_noise = VectorXd::Constant(n, noise);
  loop.sensors.encoder_resolution = VectorXd::Constant(n, noise);
  loop.sensors.seed = 1;
  SimbodyArm engine(truth);
  CommandedLog log{"made", {}};
  log.log = RunClosedLoop(plant, truth, late, loop, &engine).log;
  for (int k = 0; k < log.log.size(); ++k) {
    log.log.qref.row(k) = motion.at(log.log.t[k]).q;
  }
  return log;
}

ControllerOptions Controller(const Robot& truth) {
  ControllerOptions controller =
      DefaultController(truth, VectorXd::Zero(truth.num_joints()), 8);
  controller.feedforward = Feedforward::kNone;
  controller.torque_limit.setConstant(1e9);
  return controller;
}

std::map<std::string, double> ValuesOf(const Robot& robot) {
  std::map<std::string, double> values = {{"drive.delay", kDelay}};
  for (const Link& link : robot.links) {
    values[link.joint.name + ".viscous"] = link.joint.viscous;
    values[link.joint.name + ".coulomb"] = link.joint.coulomb;
    values[link.joint.name + ".armature"] = link.joint.armature;
  }
  return values;
}

// Armature, damping, friction and delay of Simbody's arms, from positions with
// an encoder's noise: within their deviations, which are small.
TEST(OutputErrorTest, FindsWhatPositionsTell) {
  for (const int n : {1, 3}) {
    const Robot truth = Truth(n);
    const ControllerOptions controller = Controller(truth);
    OutputErrorOptions options;
    options.trust.inertia = 0;
    const CommandedLog log = Record(truth, controller, 8, kNoise);
    const OutputErrorCalibration result =
        CalibrateOutputError(File(truth), controller, options, {log}, {log});
    ASSERT_TRUE(result.arm.converged()) << result.arm.reason;
    const auto expected = ValuesOf(truth);
    size_t found = 0;
    for (const PhysicalParameter& p : result.arm.parameters) {
      const auto value = expected.find(p.name);
      if (value == expected.end()) continue;
      ++found;
      EXPECT_TRUE(p.identifiable) << p.name;
      EXPECT_LT(p.stddev, .12 * value->second) << p.name;
      EXPECT_NEAR(p.value, value->second, 3.5 * p.stddev) << p.name;
    }
    EXPECT_EQ(found, expected.size());
    EXPECT_NEAR(result.model_error, .97, .1);
    for (int j = 0; j < n; ++j) {
      EXPECT_GT(result.positions.nominal[j], 5 * kNoise);
      EXPECT_LT(result.positions.calibrated[j], 1.2 * kNoise);
      EXPECT_LT(result.positions.validation[j], 1.2 * kNoise);
    }
    // An integral part takes any constant torque.
    EXPECT_EQ(result.arm.unseen.size(), static_cast<size_t>(n));
  }
}

// Without gravity no position tells how large torques are: with gains that are
// not known, all of them could be twice as large.
TEST(OutputErrorTest, ScaleOfTorqueNeedsGainsOrGravity) {
  Robot truth = Truth(1);
  truth.gravity.setZero();
  const ControllerOptions controller = Controller(truth);
  const CommandedLog log = Record(truth, controller, 8, kNoise);
  const auto identifiable = [&](double gains, const std::string& name) {
    OutputErrorOptions options;
    options.trust.gains = gains;
    const OutputErrorCalibration result =
        CalibrateOutputError(File(truth), controller, options, {log}, {});
    EXPECT_TRUE(result.arm.converged()) << result.arm.reason;
    for (const PhysicalParameter& p : result.arm.parameters) {
      if (p.name == name) return p.identifiable;
    }
    ADD_FAILURE() << name;
    return false;
  };
  EXPECT_TRUE(identifiable(0, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.coulomb"));
  EXPECT_FALSE(identifiable(1, "joint1.kp"));
}

}  // namespace
}  // namespace armcal
