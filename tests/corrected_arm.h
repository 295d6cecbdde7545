#pragma once

// A 3R arm whose robot file is wrong in ways that the baseline of a gap
// diagnosis can take, written by hand, and one effect beside them.
#include <cmath>

#include "calib/corrected_robot.h"
#include "model/plant/closed_loop.h"
#include "model/plant/simbody_arm.h"
#include "tests/sample_robots.h"

namespace armcal {

// Friction that falls with speed, of one parameter.
inline Effect FallingFriction() {
  Effect effect;
  effect.name = "falling_friction";
  effect.parameters.resize(1);
  effect.apply = [](const EffectSite& site, const Eigen::VectorXd& p,
                    SimulatedRobot* robot) {
    robot->joint_laws.push_back(
        {site.joint,
         {},
         true,
         [j = site.joint, size = p[0]](const ArmInstant& at, const double*,
                                       double*) {
           const double v = at.velocity[j] / .3;
           return -size * v * std::exp(-v * v);
         }});
  };
  return effect;
}

struct CorrectedArm {
  CorrectedArm() : file(SampleRobot("3R elbow")), effect(FallingFriction()) {
    std::mt19937_64 random(5);
    SetRandomInertials(&random, &file);
    for (Link& link : file.links) {
      link.joint.armature = .3;
      link.joint.viscous = 3;
      link.joint.coulomb = 4;
    }
    scale.low = Eigen::VectorXd::Constant(3, -1);
    scale.high = Eigen::VectorXd::Constant(3, 1);
    scale.width = Eigen::VectorXd::Constant(3, .006);
  }

  // What friction of joint j truly is: it changes sign within 12 mrad/s.
  static double Viscous(int j) { return 3.2 - .2 * j; }
  static double Coulomb(int j) { return 4.3 - .3 * j; }
  static constexpr double kWidth = .012;
  static constexpr double kArmature = .32;  // of all joints
  static constexpr double kSize = 2;        // N m, of the effect on joint 2
  SimulatedRobot Truth(bool with_effect) const {
    SimulatedRobot plant;
    plant.robot = file;
    for (int j = 0; j < 3; ++j) {
      plant.robot.links[j].joint.armature = kArmature;
      plant.joint_laws.push_back(
          {j, {}, false, [j](const ArmInstant& at, const double*, double*) {
             const double v = at.velocity[j];
             return -Viscous(j) * v - Coulomb(j) * std::tanh(v / kWidth);
           }});
    }
    if (with_effect) {
      effect.apply({&file, 1, &scale}, Eigen::VectorXd::Constant(1, kSize),
                   &plant);
    }
    return plant;
  }

  GapBaseline Baseline() const {
    return GapBaseline(file, {}, Eigen::VectorXd::Constant(3, 20));
  }
  // The baseline's values that say the same as Truth().
  Eigen::VectorXd TrueValues(const GapBaseline& baseline, double delay) const {
    using Kind = BaselineColumn::Kind;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(baseline.size());
    for (int c = 0; c < baseline.size(); ++c) {
      const BaselineColumn& column = baseline.columns()[c];
      const auto is = [&](JointTerm term) {
        return column.kind == Kind::kTerm &&
               column.index == static_cast<int>(term);
      };
      double value = column.kind == Kind::kTiming ? delay : 0;
      if (is(JointTerm::kViscous)) value = Viscous(column.joint) - 3;
      if (is(JointTerm::kCoulomb)) value = Coulomb(column.joint) - 4;
      if (is(JointTerm::kArmature)) value = kArmature - .3;
      // The third of the other widths, all of it.
      if (column.kind == Kind::kZeroVelocity && column.index == 2) {
        value = Coulomb(column.joint);
      }
      x[c] = value / column.spread;
    }
    return x;
  }
  // All links times as heavy as the file's: bodies that can exist.
  Eigen::VectorXd HeavierLinks(const GapBaseline& baseline,
                               double times) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(baseline.size());
    for (int c = 0; c < baseline.size(); ++c) {
      const BaselineColumn& column = baseline.columns()[c];
      if (column.kind != BaselineColumn::Kind::kInertial) continue;
      const Link& link = file.links[column.joint];
      x[c] =
          (times - 1) * link.inertial.ToVector()[column.index] / column.spread;
    }
    return x;
  }
  GapCandidate Found() const {
    GapCandidate found;
    found.effect = &effect;
    found.joint = 1;
    found.p = Eigen::VectorXd::Constant(1, kSize);
    return found;
  }
  ReferenceMotion Motion(double duration) const {
    MotionOptions motion;
    motion.duration = duration;
    return FourierMotion(file, motion);
  }
  ControllerOptions Controller() const {
    return DefaultController(file, Motion(1).at(0).q, 8);
  }
  // A log of the true arm.
  Log Record(double duration, const SensorOptions& sensors) const {
    const SimulatedRobot plant = Truth(true);
    SimbodyArm arm(plant.robot);
    ClosedLoopOptions options;
    options.controller = Controller();
    options.sensors = sensors;
    return RunClosedLoop(plant, file, Motion(duration), options, &arm).log;
  }

  Robot file;
  Effect effect;
  MotionScale scale;
};

}  // namespace armcal
