#include "calib/diagnose/judge/corrected_draws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"
#include "tests/fixtures/torque_spread.h"

namespace armcal::corrected_draws_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A simulated arm, whose friction falls with speed on one joint and whose links
// are 2 % heavier than the file's; torques with noise of 2 %.
struct Simulated {
  Simulated()
      : arm("3R elbow", 40, .005), baseline(arm.robot, {}, arm.scale.torque) {
    RecordedTorque recorded(arm.robot, baseline.transitions(), arm.motion);
    for (int j = 0; j < 3; ++j) {
      arm.scale.width[j] = baseline.transitions()[j].width;
    }
    SimulatedRobot heavier;
    heavier.robot = arm.robot;
    for (Link& link : heavier.robot.links) {
      link.inertial =
          InertialParameters::FromVector(1.02 * link.inertial.ToVector());
    }
    truth = recorded.nominal() + recorded.Change(heavier) +
            arm.Change(*FindEffect("stribeck"), 1,
                       Eigen::Vector2d(stribeck, .3 * arm.scale.speed[1]),
                       &recorded);
    MatrixXd tau = truth;
    std::mt19937_64 random(2);
    AddNoise(&random, .02 * arm.scale.torque, &tau);
    GapFitOptions options;
    options.bandwidth_hz = 6;
    for (const Effect& effect : Effects()) {
      if (effect.name != "stribeck") options.without.push_back(effect.name);
    }
    fit = std::make_unique<GapFit>(
        baseline, options,
        std::vector<GapSegment>{MakeSegment(arm.motion, tau)},
        std::vector<GapSegment>());
    fit->Choose();
    posterior = PosteriorOf(*fit);
    draws = DrawCorrected(*fit, posterior, arm.robot, kRobots);
  }

  EffectArm arm;
  GapBaseline baseline;
  const double stribeck = .3 * arm.scale.torque[1];
  MatrixXd truth;  // torque without noise
  std::unique_ptr<GapFit> fit;
  CorrectedPosterior posterior;
  CorrectedDraws draws;
};

const Simulated& Arm() {
  static const Simulated arm;
  return arm;
}

TEST(CorrectedDrawsTest, SpreadAsThePosteriorSays) {
  ASSERT_EQ(Arm().posterior.parameters.size(), 2u);
  ExpectPossible(Arm().draws);
  const TorqueSpread spread =
      SpreadOf(*Arm().fit, Arm().posterior, Arm().draws, Arm().arm.motion);
  EXPECT_NEAR(spread.Whole(), 1, .1);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(std::sqrt(spread.drawn[j] / spread.predicted[j]), 1, .3) << j;
  }
  Record(spread);
}

// Effects are drawn with the model: the log tells friction, all of it, and
// where it is of the law that falls with speed there is less of the others, so
// that the sum is known better than if they did not know of each other.
TEST(CorrectedDrawsTest, EffectsAreDrawnWithTheModel) {
  ASSERT_EQ(Arm().draws.refusal, "");
  const double v = .1 * Arm().arm.scale.speed[1];
  VectorXd law(kRobots), others(kRobots);
  for (int r = 0; r < kRobots; ++r) {
    const CorrectedRobot& robot = Arm().draws.robots[r];
    const VectorXd& p = robot.effects.at(0).found.p;
    law[r] = p[0] * std::exp(-v * v / (p[1] * p[1]));
    others[r] = v * robot.plant.robot.links[1].joint.viscous;
    for (const CoulombPart& part : robot.coulomb[1]) {
      others[r] += part.force * std::tanh(v / part.transition.width);
    }
  }
  const auto variance = [](const VectorXd& x) {
    return (x.array() - x.mean()).square().mean();
  };
  EXPECT_LT(
      std::abs(law.mean() - Arm().stribeck * std::exp(-std::pow(.1 / .3, 2))),
      4 * std::sqrt(variance(law)));
  EXPECT_GT(variance(law), 0);
  EXPECT_LT(variance(law + others), .5 * (variance(law) + variance(others)));
}

// The fitted torque is off the noiseless truth by what the robots spread: by no
// more than twice as much, and no less than a tenth.
TEST(CorrectedDrawsTest, TheTruthIsAsFarAsTheySpread) {
  ASSERT_EQ(Arm().draws.refusal, "");
  const CorrectedPosterior& posterior = Arm().posterior;
  const MatrixXd off =
      Arm().truth(Eigen::seqN(0, Arm().truth.rows() / kEvery, kEvery),
                  Eigen::all) -
      Torques(MakeCorrectedRobot(Arm().fit->baseline(), posterior.model,
                                 posterior.effects, Arm().fit->scale())
                  .plant,
              Arm().arm.motion);
  const TorqueSpread spread =
      SpreadOf(*Arm().fit, posterior, Arm().draws, Arm().arm.motion);
  for (int j = 0; j < 3; ++j) {
    const double says = spread.drawn[j];
    EXPECT_LT(off.col(j).cwiseAbs2().mean(), 4 * says) << j;
    EXPECT_GT(off.col(j).cwiseAbs2().mean(), .01 * says) << j;
  }
}

}  // namespace armcal::corrected_draws_test
