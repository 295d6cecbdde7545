#include "model/plant/hidden/hidden_effects.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "model/plant/arm_simulator.h"
#include "model/plant/hidden/joint_friction.h"
#include "model/plant/simbody_arm.h"
#include "model/text/input_error.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::hidden_effects_test {

using Eigen::VectorXd;
using Scope = HiddenEffect::Scope;

// As a diagnosis names them, in the order of model/effects/effect_list.h.
const char* const kCatalogue[] = {"viscous_friction",
                                  "coulomb_friction",
                                  "torque_offset",
                                  "asymmetric_friction",
                                  "quadratic_friction",
                                  "stribeck",
                                  "load_friction",
                                  "position_friction",
                                  "coupled_friction",
                                  "presliding",
                                  "armature",
                                  "elasticity",
                                  "backlash",
                                  "spring",
                                  "cable",
                                  "torque_ripple",
                                  "torque_gain",
                                  "torque_gain_of_all_joints",
                                  "torque_nonlinearity",
                                  "torque_saturation",
                                  "torque_deadband",
                                  "torque_crosstalk",
                                  "delay",
                                  "encoder_offset",
                                  "link_length",
                                  "base_tilt",
                                  "payload",
                                  "added_mass",
                                  "link_inertia",
                                  "thermal_friction",
                                  "viscous_friction_of_all_joints",
                                  "time_drift",
                                  "external_contact",
                                  "vibration",
                                  "time_base"};

Robot Arm(const std::string& name) {
  std::mt19937_64 random(3);
  Robot robot = SampleRobot(name);
  SetRandomInertials(&random, &robot);
  for (Link& link : robot.links) {
    link.joint.viscous = .4;
    link.joint.coulomb = .6;
    link.joint.offset = -.1;
    link.joint.armature = .1;
  }
  return robot;
}

std::vector<int> Joints(const HiddenEffect& effect, const Robot& robot) {
  if (effect.scope == Scope::kRobot) return {-1};
  std::vector<int> joints(robot.num_joints());
  for (int j = 0; j < robot.num_joints(); ++j) joints[j] = j;
  return joints;
}

TEST(HiddenEffects, EveryCatalogueNameOnceAndTenKindsOutside) {
  std::multiset<std::string> catalogue, outside;
  for (const HiddenEffect& effect : HiddenEffects()) {
    (effect.in_catalogue ? catalogue : outside).insert(effect.name);
  }
  EXPECT_THAT(std::vector<std::string>(catalogue.begin(), catalogue.end()),
              testing::UnorderedElementsAreArray(kCatalogue));
  EXPECT_GE(outside.size(), 10u);
  for (const std::string& name : outside) {
    EXPECT_EQ(outside.count(name) + catalogue.count(name), 1u) << name;
  }
}

TEST(HiddenEffects, SayWhatTheyAreAndDrawWithinTheirRange) {
  std::mt19937_64 random(4);
  for (const HiddenEffect& effect : HiddenEffects()) {
    EXPECT_GT(effect.sentence.size(), 20u) << effect.name;
    EXPECT_FALSE(effect.parameters.empty()) << effect.name;
    for (const EffectParameter& p : effect.parameters) {
      EXPECT_LT(p.low, p.high) << effect.name << " " << p.name;
      EXPECT_LE(p.least, p.low) << effect.name << " " << p.name;
      EXPECT_GE(p.most, p.high) << effect.name << " " << p.name;
      EXPECT_TRUE(p.low <= p.usual && p.usual <= p.high)
          << effect.name << " " << p.name;
      EXPECT_TRUE(p.draw == EffectParameter::Draw::kUniform || p.low > 0);
    }
    VectorXd least = DrawParameters(effect, &random).cwiseAbs();
    for (int k = 0; k < 200; ++k) {
      const VectorXd drawn = DrawParameters(effect, &random);
      least = least.cwiseMin(drawn.cwiseAbs());
      for (int i = 0; i < drawn.size(); ++i) {
        EXPECT_LE(std::abs(drawn[i]), effect.parameters[i].high);
      }
    }
    // A logarithmic range is used to its small end.
    if (effect.parameters[0].draw != EffectParameter::Draw::kUniform) {
      EXPECT_LT(least[0], 1.3 * effect.parameters[0].low) << effect.name;
    }
  }
}

// Whether the joint can show the effect; if so the arm falls for 50 ms with it
// and stays finite.
bool Swing(const HiddenEffect& effect, const Robot& robot, int joint,
           const VectorXd& p) {
  const EffectContext context = TypicalContext(robot, 5);
  SimulatedRobot simulated;
  simulated.robot = robot;
  const std::string why =
      WhyNotApplicable(effect, simulated, joint, p, context);
  if (!why.empty()) return false;
  const auto values = ApplyHiddenEffect(effect, &simulated, joint, p, context);
  AddJointFriction(.005, &simulated);
  EXPECT_FALSE(values.empty()) << effect.name;
  for (const EffectValue& value : values) {
    EXPECT_TRUE(std::isfinite(value.value)) << effect.name << value.name;
  }
  for (const Link& link : simulated.robot.links) {
    EXPECT_EQ(WhyUnphysical(link.inertial), "") << effect.name;
  }
  SimbodyArm arm(simulated.robot);
  const VectorXd q0 = VectorXd::Constant(simulated.robot.num_joints(), .1);
  ArmSimulator simulator(simulated, q0, {}, &arm);
  for (int k = 0; k < 50; ++k) {
    simulator.Step(VectorXd::Zero(robot.num_joints()));
  }
  EXPECT_TRUE(simulator.finite()) << effect.name << " on " << joint;
  // It falls, no faster than its weight can throw it.
  EXPECT_GT(simulator.instant().link_velocity.norm(), 1e-4) << effect.name;
  EXPECT_LT(simulator.instant().link_velocity.norm(), 40) << effect.name;
  return true;
}

TEST(HiddenEffects, ApplyToSixRevoluteJointsAndToAScara) {
  const std::map<std::string, std::set<std::string>> none = {
      // The first link turns about one axis, which is gravity's.
      {"UR5 6R",
       {"link_length 5", "added_mass 5", "gyroscope 0", "loose_bolt 0"}},
      // All axes are gravity's.
      {"SCARA RRPR",
       {"link_length 3", "added_mass 3", "gyroscope 0", "gyroscope 1",
        "gyroscope 2", "gyroscope 3", "loose_bolt 0", "loose_bolt 1",
        "loose_bolt 2", "loose_bolt 3"}}};
  for (const auto& [name, expected] : none) {
    const Robot robot = Arm(name);
    std::set<std::string> unfit;
    for (const HiddenEffect& effect : HiddenEffects()) {
      for (const int joint : Joints(effect, robot)) {
        if (Swing(effect, robot, joint, UsualParameters(effect))) continue;
        unfit.insert(effect.name + " " + std::to_string(joint));
      }
    }
    EXPECT_EQ(unfit, expected) << name;
  }
}

// The law keeps its sense at the ends of what is valid, or the simulator says
// that it cannot integrate it.
TEST(HiddenEffects, RunOrAreRefusedAtTheEndsOfTheirRange) {
  const Robot robot = Arm("UR5 6R");
  int refused = 0;
  for (const HiddenEffect& effect : HiddenEffects()) {
    const int joint = effect.scope == Scope::kRobot ? -1 : 2;
    for (size_t k = 0; k < effect.parameters.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      for (const double end : {parameter.least, parameter.most}) {
        VectorXd p = UsualParameters(effect);
        p[k] = end;
        try {
          EXPECT_TRUE(Swing(effect, robot, joint, p)) << effect.name;
        } catch (const InputError& error) {
          EXPECT_THAT(error.what(), testing::HasSubstr("too stiff"));
          ++refused;
        }
      }
    }
  }
  EXPECT_LT(refused, 8);
}

TEST(HiddenEffectsDeathTest, RefuseWhatIsOutOfRange) {
  const Robot robot = Arm("UR5 6R");
  const EffectContext context = TypicalContext(robot, 1);
  SimulatedRobot simulated;
  simulated.robot = robot;
  for (const HiddenEffect& effect : HiddenEffects()) {
    const int joint = effect.scope == Scope::kRobot ? -1 : 2;
    for (int k = 0; k < static_cast<int>(effect.parameters.size()); ++k) {
      VectorXd p = UsualParameters(effect);
      p[k] = 1.01 * effect.parameters[k].most;
      EXPECT_THAT(WhyNotApplicable(effect, simulated, joint, p, context),
                  testing::HasSubstr(effect.parameters[k].name))
          << effect.name;
    }
    const VectorXd p = UsualParameters(effect);
    EXPECT_NE(
        WhyNotApplicable(effect, simulated, joint == -1 ? 0 : -1, p, context),
        "")
        << effect.name;
  }
  const HiddenEffect& effect = *FindHiddenEffect("viscous_friction");
  EXPECT_DEATH(
      ApplyHiddenEffect(effect, &simulated, 0, VectorXd::Zero(1), context),
      "drag = 0: expected 0.001 to 2.5");
  EXPECT_EQ(FindHiddenEffect("viscosity"), nullptr);
}

}  // namespace armcal::hidden_effects_test
