// One effect for each slot of a SimulatedRobot, and for laws with states and
// temperature; recorded_torque_plant_long_test.cc has all.

#include <gtest/gtest.h>

#include "tests/fixtures/effect_plant.h"

namespace armcal::recorded_torque_plant_test {

using Eigen::VectorXd;

class RecordedTorqueOf : public testing::TestWithParam<const char*> {};

TEST_P(RecordedTorqueOf, IsThatOfThePlant) {
  static const auto* const kPlant = new EffectPlant(6);
  const Effect& effect = *FindEffect(GetParam());
  const int joint = effect.scope == Effect::Scope::kRobot ? -1 : 1;
  EXPECT_LT(kPlant->Disagreement(effect, joint), .05);
}

INSTANTIATE_TEST_SUITE_P(Slots, RecordedTorqueOf,
                         testing::Values("load_friction", "presliding",
                                         "thermal_friction", "armature",
                                         "payload", "elasticity", "backlash",
                                         "torque_gain", "torque_saturation",
                                         "delay", "encoder_offset",
                                         "external_contact", "time_base"),
                         [](const auto& info) { return info.param; });

// So soft and so little damped that it rings at 2 to 6 Hz while the arm beyond
// it bends and stretches, which takes and gives more than the gear's damping.
// In the second half: how it rang at the start is not recorded.
TEST(RecordedTorquePlant, OfASoftJointOfAnArmThatStretches) {
  const EffectPlant plant(20);
  const Effect& effect = *FindEffect("elasticity");
  for (int joint = 0; joint < 3; ++joint) {
    VectorXd p = plant.arm().Sizes(effect, joint);
    p[0] *= 30;
    p[1] = .02;
    for (const double stiffening : {0., .1}) {
      p[2] = stiffening;
      EXPECT_LT(plant.Disagreement(effect, joint, p, 10), .015)
          << joint << " " << stiffening;
    }
  }
}

}  // namespace armcal::recorded_torque_plant_test
