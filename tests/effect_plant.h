#pragma once

#include "model/effects/effects.h"
#include "model/low_pass.h"
#include "model/plant/closed_loop.h"
#include "model/plant/simbody_arm.h"
#include "tests/effect_arm.h"

namespace armcal {

// What effects put into recorded torque, measured on a plant that integrates
// them forward under a controller: the log with an effect minus the log
// without, each judged along its own recorded motion.
//
// An arm whose joints have friction, under a stiff controller.
class EffectPlant {
 public:
  static constexpr double kLogRate = 250, kMotionHz = 25, kJudgedHz = 6;

  explicit EffectPlant(double duration, const std::string& robot = "3R elbow")
      : arm_(robot), duration_(duration) {
    options_.sensors.log_rate_hz = kLogRate;
    const Log log = Run(Bare());
    arm_.motion = MotionOf(log);
    arm_.SetScale();
    background_ = Unexplained(log);
  }

  const EffectArm& arm() const { return arm_; }

  Log Run(const SimulatedRobot& robot) const {
    MotionOptions motion;
    motion.duration = duration_;
    const ReferenceMotion reference = FourierMotion(arm_.robot, motion);
    ClosedLoopOptions options = options_;
    options.controller =
        DefaultController(arm_.robot, reference.at(0).q, kUsualBandwidthHz);
    SimbodyArm dynamics(robot.robot);
    return RunClosedLoop(robot, arm_.robot, reference, options, &dynamics).log;
  }

  // The robot with the friction that the nominal torque has.
  SimulatedRobot Bare() const {
    SimulatedRobot robot;
    robot.robot = arm_.robot;
    for (int j = 0; j < arm_.robot.num_joints(); ++j) {
      const Joint& joint = arm_.robot.links[j].joint;
      const CoulombTransition transition = arm_.transitions[j];
      robot.joint_laws.push_back(
          {j, {}, true, [=](const ArmInstant& at, const double*, double*) {
             return -FrictionTorque(joint, transition, at.velocity[j], 0);
           }});
    }
    return robot;
  }

  static Motion MotionOf(const Log& log) {
    Motion motion;
    // As the clock has it.
    motion.t0 = log.t[0];
    motion.dt = (log.t[log.size() - 1] - log.t[0]) / (log.size() - 1);
    motion.q =
        ZeroPhaseLowPass(log.q, 1 / motion.dt, kMotionHz, Ends::kExtrapolate);
    motion.qd = Differentiate(motion.q, motion.dt);
    motion.qdd = Differentiate(motion.qd, motion.dt);
    motion.torque = {ZeroPhaseLowPass(log.tau, 1 / motion.dt, kMotionHz),
                     kMotionHz};
    return motion;
  }

  // Recorded torque that the nominal robot does not explain.
  Eigen::MatrixXd Unexplained(const Log& log) const {
    const RecordedTorque nominal(arm_.robot, arm_.transitions, MotionOf(log));
    return log.tau - nominal.nominal();
  }

  // Up to kJudgedHz, without a second at each end, where filters begin.
  static Eigen::MatrixXd Judged(const Eigen::MatrixXd& torque) {
    const Eigen::MatrixXd slow = ZeroPhaseLowPass(torque, kLogRate, kJudgedHz);
    const int cut = static_cast<int>(kLogRate);
    return slow.middleRows(cut, slow.rows() - 2 * cut);
  }

  // What effects added to a log.
  Eigen::MatrixXd Measured(const Log& log) const {
    return Judged(Unexplained(log) - background_);
  }

  // By how much what the effect (at p; of its usual size) adds to the log
  // differs from the change that is expected, as a share of it in rms; `from` a
  // time on, s.
  double Disagreement(const Effect& effect, int joint) const {
    Eigen::VectorXd p = arm_.Sizes(effect, joint);
    // Of its usual size it is as small as two logs without effects differ by
    // (1 mN m rms); this is one of its larger sizes.
    if (effect.name == "elasticity") p[0] *= 8;
    return Disagreement(effect, joint, p);
  }
  double Disagreement(const Effect& effect, int joint, const Eigen::VectorXd& p,
                      double from = 0) const {
    SimulatedRobot robot = Bare();
    effect.apply(arm_.Site(joint), p, &robot);
    const Log log = Run(robot);
    RecordedTorque recorded(arm_.robot, arm_.transitions, MotionOf(log));
    Eigen::MatrixXd expected = Judged(arm_.Change(effect, joint, p, &recorded));
    const auto rows = expected.rows() - static_cast<int>(from * kLogRate);
    const Eigen::MatrixXd measured = Measured(log).bottomRows(rows);
    expected = expected.bottomRows(rows).eval();
    return (measured - expected).norm() / expected.norm();
  }

 private:
  EffectArm arm_;
  double duration_;
  Eigen::MatrixXd background_;
  ClosedLoopOptions options_;
};

}  // namespace armcal
