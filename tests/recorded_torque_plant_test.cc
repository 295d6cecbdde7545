// One effect for each slot of a SimulatedRobot, and for laws with states and
// temperature; recorded_torque_plant_long_test.cc has all.

#include <gtest/gtest.h>

#include "tests/effect_plant.h"

namespace armcal {
namespace {

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

}  // namespace
}  // namespace armcal
