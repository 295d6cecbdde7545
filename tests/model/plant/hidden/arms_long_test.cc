// Every effect at sizes drawn from its range, on the arms of the blind bench,
// in closed loop: no law is too stiff for the integrator, and none throws the
// arm off its way.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "model/plant/hidden/scenario.h"
#include "tests/blind/blind_case.h"

namespace armcal::arms_long_test {

// False where this arm cannot show the effect.
bool DrawOn(const BlindCase& blind, const HiddenEffect& kind,
            std::mt19937_64* random, ChosenEffect* effect) {
  const EffectContext context = TypicalContext(blind.robot, 0);
  SimulatedRobot plant;
  plant.robot = blind.robot;
  effect->kind = &kind;
  if (kind.scope == HiddenEffect::Scope::kJoint) {
    effect->joint = static_cast<int>((*random)() % blind.robot.num_joints());
  }
  effect->parameters = DrawParameters(kind, random);
  return WhyNotApplicable(kind, plant, effect->joint, effect->parameters,
                          context)
      .empty();
}

TEST(HiddenArms, EveryEffectRunsOnTheArmsOfTheBench) {
  std::mt19937_64 random(11);
  std::map<std::string, double> worst;
  for (uint32_t index = 0; index < 12; ++index) {
    const BlindCase blind =
        DrawBlindCase(BlindCaseSeed(BlindSet::kCalibration, 9, index),
                      PlanCase(Stratum::kNoneRich, index));
    for (const HiddenEffect& kind : HiddenEffects()) {
      ChosenEffect effect;
      if (!DrawOn(blind, kind, &random, &effect)) continue;
      Scenario scenario = BlindScenario(blind, BlindLog::kValidation, {effect});
      scenario.motion.duration = 6;
      const ClosedLoopRun run = RunScenario(scenario).run;
      EXPECT_TRUE(run.finite) << kind.name << " on " << blind.arm;
      double& most = worst[kind.name];
      most = std::max(most, run.tracking_rms.maxCoeff());
    }
  }
  EXPECT_EQ(worst.size(), HiddenEffects().size());
  for (const auto& [name, rms] : worst) {
    std::printf("%-22s tracking %.5f rad rms\n", name.c_str(), rms);
    // A motor at its limit may not even hold the arm; all others follow.
    if (name == "torque_saturation") continue;
    EXPECT_LT(rms, .005) << name;
  }
}

}  // namespace armcal::arms_long_test
