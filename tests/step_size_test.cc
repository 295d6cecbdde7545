// Halving the step of the simulation changes a log by less than its noise, with
// every effect switched on alone.

#include <gtest/gtest.h>

#include <cmath>

#include "model/plant/hidden/scenario.h"
#include "tests/blind/blind_case.h"

namespace armcal {
namespace {

// The bench's PUMA or whichever arm an effect fits.
BlindCase CaseFor(const HiddenEffect& kind, int joint) {
  for (uint64_t seed = 0;; ++seed) {
    BlindCase blind = DrawBlindCase(seed);
    if (blind.arm != "puma" || blind.excitation != Excitation::kRich) continue;
    const bool of_joint = kind.scope == HiddenEffect::Scope::kJoint;
    blind.effects = {{&kind, of_joint ? joint : -1, UsualParameters(kind)}};
    return blind;
  }
}

Log Simulate(const BlindCase& blind, double step) {
  Scenario scenario = QuietScenario(blind, BlindLog::kTraining, blind.effects);
  MotionOptions motion;
  motion.duration = 2;
  motion.seed = 4;
  scenario.motion = WithStandstill(FourierMotion(blind.robot, motion), .2, .2);
  scenario.loop.step = step;
  return RunScenario(scenario).run.log;
}

class StepSize : public testing::TestWithParam<HiddenEffect> {};

TEST_P(StepSize, MattersLessThanNoise) {
  const BlindCase blind = CaseFor(GetParam(), 1);
  const Log coarse = Simulate(blind, 1e-3);
  const Log fine = Simulate(blind, 5e-4);
  ASSERT_EQ(coarse.size(), fine.size());
  // A tenth of the quietest noise that the bench draws.
  const Eigen::VectorXd torque = TypicalContext(blind.robot, 0).torque;
  for (int j = 0; j < 6; ++j) {
    const double rows = coarse.size();
    EXPECT_LT((coarse.q - fine.q).col(j).norm() / std::sqrt(rows), 1e-7) << j;
    EXPECT_LT((coarse.tau - fine.tau).col(j).norm() / std::sqrt(rows),
              5e-4 * torque[j])
        << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, StepSize, testing::ValuesIn(HiddenEffects()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace armcal
