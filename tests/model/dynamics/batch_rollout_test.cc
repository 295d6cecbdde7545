#include "model/dynamics/batch_rollout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/dynamics/arm_stepper.h"
#include "tests/fixtures/random_motion.h"

namespace armcal::batch_rollout_test {

using Eigen::VectorXd;

class BatchRolloutTest : public testing::TestWithParam<const simd::Kernels*> {};
INSTANTIATE_TEST_SUITE_P(InstructionSets, BatchRolloutTest,
                         testing::ValuesIn(simd::AvailableKernels()),
                         [](const auto& info) {
                           return std::string(info.param->instruction_set);
                         });

// A controller's law of (t, q, qd) for arms that differ, in any numbers of
// windows: each goes as it goes alone, to the bit; and as one arm's stepper
// does, to rounding. A window that starts as no number or runs away is told.
TEST_P(BatchRolloutTest, WindowsDoNotSeeEachOther) {
  std::mt19937_64 random(3);
  constexpr int kWindows = 19, kRunaway = 5, kNoNumber = 11, kSteps = 40;
  const Robot robot = ArmWithFrames(3, 2, &random);
  std::vector<RolloutArm> arms;
  for (int w = 0; w < kWindows; ++w) {
    arms.push_back({robot, {}, {}});
    arms[w].robot.links[2].inertial.mass += .1 * w;
    arms[w].robot.links[1].joint.viscous = 1 + w;
    arms[w].robot.links[1].joint.coulomb = w % 2;
  }
  RolloutStates states{RandomMotion::Random(&random, kWindows, 3, 2),
                       RandomMotion::Random(&random, kWindows, 3, 1),
                       {},
                       {}};
  states.q(kNoNumber, 2) = std::nan("");
  const RolloutStates begin = states;
  const auto law = [](double t, double q, double qd) {
    return std::sin(9 * t) - 3 * q - .2 * qd;
  };
  const auto torque = [&](const BatchRollout::Batch& at, double* from,
                          double* to) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < at.count; ++k) {
        const long i = j * at.stride + k;
        from[i] = to[i] = law(at.t, at.q[i], at.qd[i]);
        if (at.first + k == kRunaway && at.t > .03) {
          from[i] = std::nan("");
        }
      }
    }
  };
  long visits = 0;
  BatchRollout(arms, *GetParam())
      .Run(
          0, 2e-3, kSteps, torque,
          [&](const BatchRollout::Batch&) { ++visits; }, &states);
  const int lanes = GetParam()->lanes;
  EXPECT_EQ(visits, kSteps * ((kWindows + lanes - 1) / lanes));
  EXPECT_EQ(states.lost[kNoNumber], 0);
  EXPECT_EQ(states.lost[kRunaway], 17);  // from the step at .032 s on
  for (int w = 0; w < kWindows; ++w) {
    if (w == kNoNumber || w == kRunaway) continue;
    EXPECT_EQ(states.lost[w], -1);
    RolloutStates alone{begin.q.row(w), begin.qd.row(w), {}, {}};
    BatchRollout({arms[w]}, *GetParam())
        .Run(
            0, 2e-3, kSteps,
            [&](const BatchRollout::Batch& at, double* from, double* to) {
              for (int j = 0; j < 3; ++j) {
                const long i = j * at.stride;
                from[i] = to[i] = law(at.t, at.q[i], at.qd[i]);
              }
            },
            nullptr, &alone);
    EXPECT_EQ(states.q.row(w), alone.q.row(0)) << w;
    EXPECT_EQ(states.qd.row(w), alone.qd.row(0)) << w;
    ArmStepper stepper(arms[w], *GetParam());
    stepper.SetState(begin.q.row(w), begin.qd.row(w));
    VectorXd tau(3);
    for (int k = 0; k < kSteps; ++k) {
      for (int j = 0; j < 3; ++j) {
        tau[j] = law(2e-3 * k, stepper.q()[j], stepper.qd()[j]);
      }
      EXPECT_TRUE(stepper.Advance(2e-3, tau, tau));
    }
    EXPECT_LT((stepper.q().transpose() - states.q.row(w)).norm(), 1e-12);
  }
}

}  // namespace armcal::batch_rollout_test
