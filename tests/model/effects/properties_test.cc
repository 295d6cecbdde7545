// What effects say of themselves agrees with their laws.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/motor_map.h"
#include "model/dynamics/recorded_torque.h"
#include "model/effects/effects.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/model/effects/every_effect.h"

namespace armcal::properties_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Search = EffectParameter::Search;

TEST(ContactEffect, IsTheOnlyPush) {
  EXPECT_EQ(ContactEffect().name, "external_contact");
  EXPECT_EQ(std::count_if(Effects().begin(), Effects().end(),
                          [](const Effect& e) { return e.is_contact; }),
            1);
}

TEST(ClockEffect, IsTheOnlyClock) {
  EXPECT_EQ(ClockEffect().name, "time_base");
  EXPECT_EQ(std::count_if(Effects().begin(), Effects().end(),
                          [](const Effect& e) { return e.is_clock; }),
            1);
}

class PropertiesOf : public EveryEffect {};

// A law that does not say that it sees links gives the same torque, and the
// same rates, wherever these are.
TEST_P(PropertiesOf, LooksAtLinksOnlyIfItSaysSo) {
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque*) {
    SimulatedRobot changed;
    changed.robot = arm.robot;
    GetParam().apply(arm.Site(joint), sizes, &changed);
    ArmInstant with_motors;
    with_motors.t = 1;
    with_motors.position = with_motors.link_position = arm.motion.q.row(9);
    with_motors.velocity = with_motors.link_velocity = arm.motion.qd.row(9);
    with_motors.load = with_motors.temperature = arm.motion.q.row(7);
    ArmInstant elsewhere = with_motors;
    elsewhere.link_position = elsewhere.link_velocity = arm.motion.qdd.row(5);
    for (const JointLaw& law : changed.joint_laws) {
      if (law.sees_link) continue;
      const VectorXd state = VectorXd::Constant(law.initial_state.size(), .1);
      VectorXd rate = state, other_rate = state;
      EXPECT_EQ(law.torque(with_motors, state.data(), rate.data()),
                law.torque(elsewhere, state.data(), other_rate.data()));
      EXPECT_EQ(rate, other_rate);
    }
  });
}

// What it gives of a command, and the command of what it gives.
TEST_P(PropertiesOf, InvertsItsMotor) {
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque*) {
    SimulatedRobot changed;
    changed.robot = arm.robot;
    GetParam().apply(arm.Site(joint), 5 * sizes, &changed);
    for (const ActuatorMap& map : changed.actuators) {
      const auto* motor = map.apply.target<MotorMap>();
      if (motor == nullptr || !motor->commanded) continue;
      for (const double given : {-20., -1., -1e-3, 0., 1e-3, 1., 20.}) {
        EXPECT_NEAR(motor->given(motor->commanded(given), 1), given, 1e-9);
      }
    }
  });
}

// An effect without larger sizes is judged by a column: its torque at other
// sizes is that, times a factor. A length and a clock are in it squared as
// well.
TEST_P(PropertiesOf, IsInProportionUnlessItHasLargerSizes) {
  if (!GetParam().larger_sizes.empty() || !GetParam().proportional) return;
  const bool bends = GetParam().name == "link_length" || GetParam().is_clock;
  const double tolerance = bends ? .12 : 1e-9;
  const auto& parameters = GetParam().parameters;
  const bool has_sign =
      std::any_of(parameters.begin(), parameters.end(),
                  [](const EffectParameter& parameter) {
                    return parameter.sign == EffectParameter::Sign::kPositive;
                  });
  const double factor = has_sign ? 12 : -12;
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque* recorded) {
    VectorXd larger = sizes;
    for (Eigen::Index k = 0; k < sizes.size(); ++k) {
      if (parameters[k].search == Search::kLinear) larger[k] *= factor;
    }
    const auto change = [&](const VectorXd& p) {
      SimulatedRobot changed;
      changed.robot = arm.robot;
      GetParam().apply(arm.Site(joint), p, &changed);
      return recorded->Change(changed);
    };
    const MatrixXd torque = change(sizes);
    EXPECT_LT((change(larger) - factor * torque).norm(),
              tolerance * std::abs(factor) * torque.norm());
  });
}

TEST_P(PropertiesOf, HappensOnceIfItIsAnEvent) {
  const auto& parameters = GetParam().parameters;
  EXPECT_EQ(GetParam().nature == Effect::Nature::kEvent,
            std::any_of(parameters.begin(), parameters.end(),
                        [](const EffectParameter& parameter) {
                          return parameter.search == Search::kTime;
                        }));
}

// The one parameter of a joint term has its unit, and its torque is as if the
// joint had that much more of it.
TEST_P(PropertiesOf, AddsToItsJointTerm) {
  if (!GetParam().joint_term) return;
  ASSERT_EQ(GetParam().parameters.size(), 1u);
  const JointTerm term = *GetParam().joint_term;
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque* recorded) {
    const JointType type = arm.robot.links[joint].joint.type;
    EXPECT_EQ(EstimatesOf(GetParam(), arm.Site(joint), sizes)[0].unit,
              JointTermUnit(term, type));
    Robot more = arm.robot;
    *TermOf(term, &more.links[joint].joint) += sizes[0];
    const MatrixXd expected =
        RecordedTorque(more, arm.transitions, arm.motion).nominal() -
        recorded->nominal();
    const MatrixXd change = arm.Change(GetParam(), joint, sizes, recorded);
    EXPECT_LT((change - expected).norm(), 1e-9 * expected.norm());
  });
}

// What a model without the law would show in its stead, files without it have.
TEST_P(PropertiesOf, StandInsAreItsMeans) {
  const std::vector<JointTerm>& stand_ins = GetParam().stand_ins;
  for (const std::string& mean : GetParam().means) {
    const std::optional<JointTerm> term = FindEffect(mean)->joint_term;
    // A spring, as a cable is near its centre, has no number in files.
    if (mean == "spring") continue;
    ASSERT_TRUE(term) << mean;
    // That of a joint that yields is in the links that it carries, too.
    if (*term == JointTerm::kArmature) continue;
    EXPECT_EQ(std::count(stand_ins.begin(), stand_ins.end(), *term), 1) << mean;
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, PropertiesOf, testing::ValuesIn(Effects()),
                         [](const auto& info) { return info.param.name; });

// On a head that pans and tilts about one point a mass at that point is felt by
// no joint: what hangs on it is a moment of its link, and on other arms a
// payload.
TEST(PayloadEffect, IsOnAToolThatMoves) {
  Robot arm = SampleRobot("2R planar (vertical plane)");
  std::mt19937_64 random(1);
  SetRandomInertials(&random, &arm);
  MotionScale scale;
  scale.torque = scale.speed = scale.acceleration = Eigen::VectorXd::Ones(2);
  scale.low = -Eigen::VectorXd::Ones(2);
  scale.high = Eigen::VectorXd::Ones(2);
  const auto fits = [&](const std::string& name, int joint) {
    return FindEffect(name)->unfit({&arm, joint, &scale}).empty();
  };
  EXPECT_TRUE(fits("payload", -1));
  EXPECT_FALSE(fits("added_mass", 1));
  for (Link& link : arm.links) {
    link.X_PF.translation().setZero();
    link.X_ML.translation().setZero();
  }
  EXPECT_FALSE(fits("payload", -1));
  EXPECT_TRUE(fits("added_mass", 1));
}

}  // namespace armcal::properties_test
