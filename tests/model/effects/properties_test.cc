// What effects say of themselves agrees with their laws.

#include <gtest/gtest.h>

#include <algorithm>

#include "model/dynamics/joint_term.h"
#include "model/dynamics/recorded_torque.h"
#include "model/effects/effects.h"
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

// What else there is (posture, load, warmth, the other joints) changes nothing.
TEST_P(PropertiesOf, DependsOnItsVelocityAlone) {
  if (!GetParam().velocity_friction) return;
  Everywhere([&](const EffectArm& arm, int joint, const VectorXd& sizes,
                 RecordedTorque*) {
    SimulatedRobot robot;
    robot.robot = arm.robot;
    GetParam().apply(arm.Site(joint), sizes, &robot);
    ASSERT_EQ(robot.joint_laws.size(), 1u);
    const JointLaw& law = robot.joint_laws[0];
    const auto torque = [&](double others) {
      ArmInstant at;
      at.position = at.velocity = at.load = at.temperature =
          VectorXd::Constant(arm.robot.num_joints(), others);
      at.velocity[joint] = .3;
      at.link_position = at.position;
      at.link_velocity = at.velocity;
      VectorXd state = law.initial_state.array() + .5, rate = state;
      return law.torque(at, state.data(), rate.data());
    };
    EXPECT_EQ(law.joint, joint);
    EXPECT_LT(torque(1), 0);
    EXPECT_EQ(torque(1), torque(7));
  });
}

INSTANTIATE_TEST_SUITE_P(Catalogue, PropertiesOf, testing::ValuesIn(Effects()),
                         [](const auto& info) { return info.param.name; });

}  // namespace armcal::properties_test
