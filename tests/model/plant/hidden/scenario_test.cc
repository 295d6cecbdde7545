#include "model/plant/hidden/scenario.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fixtures/sample_robots.h"

namespace armcal::scenario_test {

using Eigen::VectorXd;

Scenario Arm(double duration, const std::vector<ChosenEffect>& effects) {
  std::mt19937_64 random(3);
  Scenario scenario;
  scenario.model = SampleRobot("UR5 6R");
  SetRandomInertials(&random, &scenario.model);
  for (Link& link : scenario.model.links) {
    link.joint.viscous = .4;
    link.joint.coulomb = .6;
    link.joint.armature = .1;
  }
  scenario.motion = {duration, [](double) -> ReferencePoint {
                       const VectorXd zero = VectorXd::Zero(6);
                       return {VectorXd::Constant(6, .3), zero, zero};
                     }};
  scenario.loop.controller =
      DefaultController(scenario.model, scenario.motion.at(0).q, 8);
  scenario.effects = effects;
  return scenario;
}

// All that laws say at one instant, and what heats.
VectorXd Physics(const Scenario& scenario, const ChosenEffect& effect,
                 std::vector<EffectValue>* values) {
  SimulatedRobot robot = TrueRobot(scenario);
  *values = ApplyHiddenEffect(*effect.kind, &robot, effect.joint,
                              effect.parameters, ContextOf(scenario));
  const int n = robot.robot.num_joints();
  ArmInstant at;
  at.t = 15;
  at.position = at.link_position = VectorXd::Constant(n, .4);
  at.velocity = at.link_velocity = VectorXd::Constant(n, .7);
  at.load = VectorXd::Constant(n, 3);
  at.temperature = VectorXd::Constant(n, 12);
  const VectorXd state = VectorXd::Constant(50, .01);
  std::vector<double> all;
  const auto keep = [&all](const VectorXd& x) {
    all.insert(all.end(), x.begin(), x.end());
  };
  VectorXd rate = VectorXd::Zero(50);
  for (const JointLaw& law : robot.joint_laws) {
    all.push_back(law.torque(at, state.data(), rate.data()));
    keep(rate);
  }
  for (const ActuatorMap& map : robot.actuators) {
    VectorXd torque = VectorXd::Constant(n, 5);
    map.apply(at, state.data(), rate.data(), &torque);
    keep(torque);
    keep(rate);
  }
  for (const SensorMap& map : robot.sensors) {
    Reading reading{at.position, at.velocity, at.load, at.temperature};
    map.apply(at, &reading);
    keep(reading.position);
    keep(reading.velocity);
  }
  for (const JointThermal& thermal : robot.thermal) {
    all.push_back(thermal.capacity);
    all.push_back(thermal.resistance);
  }
  return Eigen::Map<VectorXd>(all.data(), all.size());
}

// A robot does not know how long the log will be.
TEST(Scenario, LogsOfAnyLengthAreOfOneRobot) {
  for (const HiddenEffect& kind : HiddenEffects()) {
    // Placed within the log: a contact and a brake come and go.
    if (kind.name == "external_contact" || kind.name == "dragging_brake") {
      continue;
    }
    const bool of_joint = kind.scope == HiddenEffect::Scope::kJoint;
    const ChosenEffect effect = {&kind, of_joint ? 1 : -1,
                                 UsualParameters(kind)};
    std::vector<EffectValue> values, other;
    const VectorXd brief = Physics(Arm(9, {}), effect, &values);
    const VectorXd lengthy = Physics(Arm(42, {}), effect, &other);
    ASSERT_EQ(brief.size(), lengthy.size());
    EXPECT_EQ((brief - lengthy).norm(), 0) << kind.name;
    for (size_t k = 0; k < values.size(); ++k) {
      EXPECT_EQ(values[k].value, other[k].value) << kind.name;
    }
  }
}

// Nothing but the effect tells: at rest, where it scales next to nothing, the
// log's velocities are as noisy as those of any robot.
TEST(Scenario, AnAgingTachometerIsAsNoisyAsOthers) {
  const auto noise = [](const std::vector<ChosenEffect>& effects) {
    Scenario scenario = Arm(2, effects);
    scenario.loop.sensors.encoder_noise = VectorXd::Constant(6, 3e-6);
    const Eigen::MatrixXd qd = RunScenario(scenario).run.log.qd;
    return VectorXd(qd.colwise().norm().transpose());
  };
  const HiddenEffect& kind = *FindHiddenEffect("aging_tachometer");
  const VectorXd aging = noise({{&kind, 2, VectorXd::Constant(1, .1)}});
  const VectorXd plain = noise({});
  for (int j = 0; j < 6; ++j) {
    EXPECT_NEAR(aging[j] / plain[j], 1, .02) << j;
  }
}

// Two engines that share no code move the arm alike, with a wrench and another
// rigid body in it.
TEST(Scenario, BothEnginesWriteTheSameLog) {
  const HiddenEffect* slosh = FindHiddenEffect("slosh");
  const HiddenEffect* payload = FindHiddenEffect("payload");
  Scenario scenario = Arm(0, {{slosh, -1, UsualParameters(*slosh)},
                              {payload, -1, UsualParameters(*payload)}});
  MotionOptions motion;
  motion.duration = 2;
  scenario.motion = FourierMotion(scenario.model, motion);
  const Log simbody = RunScenario(scenario).run.log;
  const Log own = RunScenario(scenario, ScenarioEngine::kRigidArm).run.log;
  ASSERT_EQ(simbody.size(), own.size());
  EXPECT_LT((simbody.q - own.q).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((simbody.tau - own.tau).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GT(simbody.tau.cwiseAbs().maxCoeff(), 1);
}

}  // namespace armcal::scenario_test
