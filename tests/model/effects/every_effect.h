#pragma once

#include <gtest/gtest.h>

#include "model/dynamics/recorded_torque.h"
#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"

namespace armcal {

// A test of an effect, on joints that turn and on joints that slide.
class EveryEffect : public testing::TestWithParam<Effect> {
 protected:
  static const EffectArm& Arm(bool prismatic) {
    static const auto* const kPuma = new EffectArm("PUMA560 6R");
    static const auto* const kScara = new EffectArm("SCARA RRPR");
    return prismatic ? *kScara : *kPuma;
  }

  // Calls f(arm, joint, sizes, recorded torque) wherever the effect can be.
  template <typename F>
  void Everywhere(const F& f) const {
    for (const bool prismatic : {false, true}) {
      const EffectArm& arm = Arm(prismatic);
      RecordedTorque recorded = arm.Recorded();
      for (const int joint : arm.Joints(GetParam())) {
        SCOPED_TRACE(testing::Message() << arm.robot.name << joint + 1);
        f(arm, joint, arm.Sizes(GetParam(), joint), &recorded);
      }
    }
  }
};

}  // namespace armcal
