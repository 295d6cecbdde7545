#include "calib/diagnose/select/rivals.h"

#include <gtest/gtest.h>

#include <random>

#include "calib/diagnose/select/fit.h"
#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::rivals_test {

// Of a joint's friction: all of it by a law of three parameters, and nearly all
// by a law of one.
TEST(LeaveOutErrorsOfForm, OfLawsThatAreNoBetterThanSimplerOnes) {
  std::vector<FittedRival> rivals = {{2, 1000, 20}, {2, 980, 7}, {2, 900, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 980);
  EXPECT_EQ(rivals[1].delta_chi2, 980);
  EXPECT_EQ(rivals[2].delta_chi2, 900);
}

TEST(LeaveOutErrorsOfForm, NotOfLawsThatAreBetter) {
  std::vector<FittedRival> rivals = {{2, 1000, 20}, {2, 960, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 1000);
}

// What is as simple is told apart by the data, and so are other joints and the
// whole robot.
TEST(LeaveOutErrorsOfForm, OfTheSameJointAndRicher) {
  std::vector<FittedRival> rivals = {
      {2, 1000, 20}, {2, 990, 20}, {1, 990, 7}, {-1, 990, 7}};
  LeaveOutErrorsOfForm(.03, &rivals);
  EXPECT_EQ(rivals[0].delta_chi2, 1000);
  EXPECT_EQ(rivals[1].delta_chi2, 990);
}

// Viscous friction of one joint beside a soft gear of another, whose law bends:
// at the size of its column it is worth less than that. The friction's own
// score is what it explains, whatever the gear's law loses.
TEST(CompareRivals, OfALinearEffectIsWhatItsColumnExplains) {
  constexpr double kBandwidth = 6;  // Hz
  EffectArm arm("PUMA560 6R", 30, .005);
  const GapBaseline baseline(arm.robot, {}, Eigen::VectorXd::Constant(6, 10));
  SimulatedRobot robot;
  robot.robot = arm.robot;
  robot.robot.links[3].joint.viscous += 2;
  FindEffect("elasticity")
      ->apply(arm.Site(1), Eigen::Vector3d(4e-3, .05, 0), &robot);
  RecordedTorque recorded(arm.robot, baseline.transitions(), arm.motion);
  Eigen::MatrixXd tau = recorded.nominal() + recorded.Change(robot);
  std::mt19937_64 random(7);
  AddNoise(&random, Eigen::VectorXd::Constant(6, .3), &tau);
  GapFitOptions options;
  options.bandwidth_hz = kBandwidth;
  GapFit fit(baseline, options, {MakeSegment(arm.motion, tau)}, {});
  fit.Choose();
  bool is_viscous_found = false, is_gear_found = false;
  for (size_t k = 0; k < fit.refined().effects.size(); ++k) {
    const GapCandidate& effect = fit.refined().effects[k];
    is_gear_found |= effect.effect->name == "elasticity" && effect.joint == 1;
    if (effect.effect->name != "viscous_friction" || effect.joint != 3) {
      continue;
    }
    is_viscous_found = true;
    for (const RefinedScore& rival : fit.rivals(k)) {
      if (rival.effect != effect.effect) continue;
      const double explained = fit.selection().delta_chi2[k];
      EXPECT_NEAR(rival.score, explained, .1 * explained);
    }
  }
  EXPECT_TRUE(is_viscous_found);
  EXPECT_TRUE(is_gear_found);
}

}  // namespace armcal::rivals_test
