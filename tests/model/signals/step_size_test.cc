// Halving the step of the simulation changes a log by less than its noise, with
// every effect switched on alone.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "model/plant/hidden/scenario.h"
#include "tests/blind/blind_case.h"

namespace armcal::step_size_test {

// An arm of the bench, a joint and sizes drawn for each effect, `draw` of them.
BlindCase CaseFor(const HiddenEffect& kind, uint32_t draw) {
  uint32_t index = 0;
  while (HiddenEffects()[index].name != kind.name) ++index;
  std::seed_seq sequence{index, draw};
  std::mt19937_64 random(sequence);
  while (true) {
    BlindCase blind =
        DrawBlindCase(random() >> 1, PlanCase(Stratum::kNoneRich, draw));
    const bool of_joint = kind.scope == HiddenEffect::Scope::kJoint;
    const int n = blind.robot.num_joints();
    const ChosenEffect effect = {&kind,
                                 of_joint ? static_cast<int>(random() % n) : -1,
                                 DrawParameters(kind, &random)};
    SimulatedRobot plant;
    plant.robot = blind.robot;
    if (!WhyNotApplicable(kind, plant, effect.joint, effect.parameters,
                          TypicalContext(blind.robot, 0))
             .empty()) {
      continue;
    }
    blind.effects = {effect};
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
  scenario.loop.settle = .1;
  return RunScenario(scenario).run.log;
}

std::string Text(const BlindCase& blind) {
  const ChosenEffect& effect = blind.effects[0];
  std::ostringstream text;
  text << blind.arm << " joint " << effect.joint + 1 << ", "
       << effect.parameters.transpose();
  return text.str();
}

class StepSize : public testing::TestWithParam<HiddenEffect> {};

TEST_P(StepSize, MattersLessThanNoise) {
  const BlindCase blind = CaseFor(GetParam(), 0);
  const Log coarse = Simulate(blind, 1e-3);
  const Log fine = Simulate(blind, 5e-4);
  ASSERT_EQ(coarse.size(), fine.size());
  // Half of the finest encoders' noise, a tenth of the quietest torque's, that
  // the bench draws.
  const Eigen::VectorXd torque = TypicalContext(blind.robot, 0).torque;
  const auto rms = [&](const Eigen::MatrixXd& difference, int j) {
    return difference.col(j).norm() / std::sqrt(coarse.size());
  };
  for (int j = 0; j < blind.robot.num_joints(); ++j) {
    EXPECT_LT(rms(coarse.q - fine.q, j), 3e-7) << j + 1 << ": " << Text(blind);
    EXPECT_LT(rms(coarse.tau - fine.tau, j) / torque[j], 5e-4)
        << j + 1 << ": " << Text(blind);
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, StepSize, testing::ValuesIn(HiddenEffects()),
                         [](const auto& info) { return info.param.name; });

}  // namespace armcal::step_size_test
