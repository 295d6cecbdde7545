// Every effect on every joint, against the plant.

#include <gtest/gtest.h>

#include "tests/fixtures/effect_plant.h"

namespace armcal::recorded_torque_plant_long_test {

TEST(RecordedTorqueLong, IsThatOfThePlant) {
  const EffectPlant plant(10);
  for (const Effect& effect : Effects()) {
    for (const int joint : plant.arm().Joints(effect)) {
      EXPECT_LT(plant.Disagreement(effect, joint), .05)
          << effect.name << joint + 1;
    }
  }
}

}  // namespace armcal::recorded_torque_plant_long_test
