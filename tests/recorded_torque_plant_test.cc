// What effects put into recorded torque, against a plant that integrates them
// forward under a controller: the log with an effect minus the log without,
// each judged along its own recorded motion.

#include <gtest/gtest.h>

#include <cmath>

#include "model/effects/effects.h"
#include "model/low_pass.h"
#include "model/plant/closed_loop.h"
#include "model/plant/simbody_arm.h"
#include "tests/effect_arm.h"

namespace armcal {
inline namespace effects {
void PrintTo(const Effect& effect, std::ostream* out) { *out << effect.name; }
}  // namespace effects

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLogRate = 250, kMotionHz = 25, kJudgedHz = 6;

// An elbow whose joints have friction, under a stiff controller.
class Plant {
 public:
  Plant() : arm_("3R elbow") {
    options_.sensors.log_rate_hz = kLogRate;
    arm_.motion = MotionOf(Run(Bare()));
    arm_.SetScale();
  }

  const EffectArm& arm() const { return arm_; }

  Log Run(const SimulatedRobot& robot) const {
    MotionOptions motion;
    motion.duration = 10;
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
    motion.dt = 1 / kLogRate;
    motion.q = ZeroPhaseLowPass(log.q, kLogRate, kMotionHz, Ends::kExtrapolate);
    motion.qd = Differentiate(motion.q, motion.dt);
    motion.qdd = Differentiate(motion.qd, motion.dt);
    motion.torque = ZeroPhaseLowPass(log.tau, kLogRate, kMotionHz);
    return motion;
  }

  // Recorded torque that the nominal robot does not explain.
  MatrixXd Unexplained(const Log& log) const {
    const RecordedTorque nominal(arm_.robot, arm_.transitions, MotionOf(log));
    return log.tau - nominal.nominal();
  }

 private:
  EffectArm arm_;
  ClosedLoopOptions options_;
};

const Plant& ThePlant() {
  static const auto* const kPlant = new Plant;
  return *kPlant;
}
const MatrixXd& Background() {
  static const auto* const kBackground =
      new MatrixXd(ThePlant().Unexplained(ThePlant().Run(ThePlant().Bare())));
  return *kBackground;
}

// Up to kJudgedHz, without a second at each end, where filters begin.
MatrixXd Judged(const MatrixXd& torque) {
  const MatrixXd slow = ZeroPhaseLowPass(torque, kLogRate, kJudgedHz);
  const int cut = static_cast<int>(kLogRate);
  return slow.middleRows(cut, slow.rows() - 2 * cut);
}

class RecordedTorqueOf : public testing::TestWithParam<Effect> {};

TEST_P(RecordedTorqueOf, IsThatOfThePlant) {
  const Effect& effect = GetParam();
  const Plant& plant = ThePlant();
  const EffectArm& arm = plant.arm();
  const int joint = effect.scope == Effect::Scope::kRobot ? -1 : 1;
  const VectorXd p = arm.Sizes(effect, joint);
  SimulatedRobot robot = plant.Bare();
  effect.apply(arm.Site(joint), p, &robot);
  const Log log = plant.Run(robot);
  const MatrixXd measured = Judged(plant.Unexplained(log) - Background());

  RecordedTorque recorded(arm.robot, arm.transitions, Plant::MotionOf(log));
  const MatrixXd expected = Judged(arm.Change(effect, joint, p, &recorded));
  EXPECT_LT((measured - expected).norm(), .05 * expected.norm())
      << ColumnRms(measured).transpose() << " and "
      << ColumnRms(expected).transpose() << " off by "
      << ColumnRms(measured - expected).transpose();
}

INSTANTIATE_TEST_SUITE_P(Catalogue, RecordedTorqueOf,
                         testing::ValuesIn(Effects()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace armcal
