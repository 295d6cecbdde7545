#include "calib/diagnose/candidates/refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::refinement_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz
constexpr double kNoise = .2;     // N m, white, at 200 Hz

// A regression on recorded torque that has an effect of known parameters and
// errors of the file as large as its prior says.
class GapRefinementTest : public testing::Test {
 protected:
  GapRefinementTest()
      : arm_("2R planar (vertical plane)", 20, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {}

  void Record(const Effect& effect, int joint, const VectorXd& p) {
    VectorXd x = VectorXd::Zero(baseline_.size());
    for (int c = 0; c < x.size(); ++c) {
      const auto kind = baseline_.columns()[c].kind;
      if (kind == BaselineColumn::Kind::kInertial ||
          kind == BaselineColumn::Kind::kTerm) {
        x[c] = Normal(&random_);
      }
    }
    GapSegment segment;
    segment.motion = arm_.motion;
    RecordedTorque recorded(arm_.robot, baseline_.transitions(), arm_.motion);
    segment.tau =
        RecordedTorque(baseline_.With(x), baseline_.transitions(), arm_.motion)
            .nominal() +
        arm_.Change(effect, joint, p, &recorded);
    MatrixXd noise = MatrixXd::Zero(segment.tau.rows(), 2);
    AddNoise(&random_, VectorXd::Constant(2, kNoise), &noise);
    segment.tau += noise;
    segment.still.setConstant(segment.size(), 2, false);
    data_.emplace(std::vector<GapSegment>{segment}, baseline_, kBandwidth);
    const MatrixXd thin = data_->rows().Thin(0, noise);
    data_->SetNoise({FitAutoregression({thin.col(0)}, false),
                     FitAutoregression({thin.col(1)}, false)});
  }
  RefinedEffects Refine(const Effect& effect, int joint, const VectorXd& from) {
    GapScreen screen = data_->Screen();
    screen.Factor();
    GapCandidate start;
    start.effect = &effect;
    start.joint = joint;
    start.p = from;
    for (size_t k = 0; k < effect.parameters.size(); ++k) {
      const EffectParameter& parameter = effect.parameters[k];
      if (parameter.search != EffectParameter::Search::kLinear) continue;
      start.linear.push_back(static_cast<int>(k));
      start.size.conservativeResize(start.linear.size());
      start.size.tail(1)[0] = parameter.size(arm_.Site(joint));
    }
    return RefineEffects(screen, baseline_, arm_.scale, {start}, -1, &*data_);
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{5};
  std::optional<GapData> data_;
};

TEST_F(GapRefinementTest, AStribeckVelocityOffTheGridIsFound) {
  const Effect& stribeck = *FindEffect("stribeck");
  const Eigen::Vector2d truth(1, .137);
  Record(stribeck, 1, truth);
  const RefinedEffects refined = Refine(stribeck, 1, Eigen::Vector2d(.6, .08));
  const VectorXd& p = refined.effects[0].p;
  for (int k = 0; k < 2; ++k) {
    const double stddev = std::sqrt(refined.covariance(k, k));
    EXPECT_NEAR(p[k], truth[k], 4 * stddev) << k;
    EXPECT_LT(stddev, .2 * truth[k]) << k;
  }
  EXPECT_GT(refined.delta_chi2, 100);
}

TEST_F(GapRefinementTest, ARipplesHarmonicIsFoundBetweenPeaks) {
  const Effect& ripple = *FindEffect("torque_ripple");
  const Eigen::Vector3d truth(.5, -.3, 17.3);
  Record(ripple, 0, truth);
  const double range = arm_.scale.high[0] - arm_.scale.low[0];
  // A quarter of a wave off, from one end of the range to the other.
  const RefinedEffects refined =
      Refine(ripple, 0, Eigen::Vector3d(.3, 0, 17.3 + M_PI / 2 / range));
  EXPECT_NEAR(refined.effects[0].p[2], 17.3,
              4 * std::sqrt(refined.covariance(2, 2)));
  EXPECT_NEAR(refined.effects[0].p.head(2).norm(), truth.head(2).norm(), .05);
}

// An effect that only takes power stays at the bound and has no variance there.
TEST_F(GapRefinementTest, SignsHold) {
  const Effect& stribeck = *FindEffect("stribeck");
  Record(stribeck, 1, Eigen::Vector2d(-1, .137));
  const RefinedEffects refined = Refine(stribeck, 1, Eigen::Vector2d(.2, .137));
  EXPECT_NEAR(refined.effects[0].p[0], 0, 1e-3);
  EXPECT_EQ(refined.covariance(0, 0), 0);
}

// A law that runs away is no explanation, and no error either.
TEST_F(GapRefinementTest, ATorqueThatIsNotFiniteExplainsLessThanNothing) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Effect& viscous = *FindEffect("viscous_friction");
  Effect burning = viscous;
  burning.apply = [&](const EffectSite& site, const VectorXd&,
                      SimulatedRobot* robot) {
    viscous.apply(site, VectorXd::Constant(1, kInfinite), robot);
  };
  Record(viscous, 1, VectorXd::Constant(1, .5));
  const RefinedEffects refined = Refine(burning, 1, VectorXd::Ones(1));
  EXPECT_EQ(refined.delta_chi2, -kInfinite);
  EXPECT_EQ(refined.effects[0].p[0], 1);
  EXPECT_TRUE(refined.covariance.allFinite());
  EXPECT_TRUE(refined.baseline.allFinite());
}

// chi^2 of 40 runs, three of its deviations.
TEST_F(GapRefinementTest, CovarianceIsThatOfManyRuns) {
  constexpr int kRuns = 40;
  const Effect& stribeck = *FindEffect("stribeck");
  const Eigen::Vector2d truth(1, .137);
  Eigen::Vector2d squares(0, 0);
  for (int run = 0; run < kRuns; ++run) {
    Record(stribeck, 1, truth);
    const RefinedEffects refined = Refine(stribeck, 1, truth);
    for (int k = 0; k < 2; ++k) {
      squares[k] += std::pow(refined.effects[0].p[k] - truth[k], 2) /
                    refined.covariance(k, k) / kRuns;
    }
  }
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(squares[k], .33) << k;
    EXPECT_LT(squares[k], 1.67) << k;
  }
}

// A gap whose flanks are stiffer than the catalogue allows: the fit ends at
// that bound, and in the minimum along it, from where another fit gains
// nothing.
TEST_F(GapRefinementTest, EndsInTheMinimumAlongABound) {
  const Effect& backlash = *FindEffect("backlash");
  const double gap = 8 * backlash.parameters[0].size(arm_.Site(0));
  const double stiffest = backlash.parameters[1].grid(arm_.Site(0)).front();
  Record(backlash, 0, Eigen::Vector3d(gap, stiffest / 3, .2));
  const RefinedEffects once =
      Refine(backlash, 0, Eigen::Vector3d(.8 * gap, 3 * stiffest, .2));
  EXPECT_DOUBLE_EQ(once.effects[0].p[1], stiffest);
  const RefinedEffects twice = Refine(backlash, 0, once.effects[0].p);
  EXPECT_LT(twice.delta_chi2 - once.delta_chi2, .1);
}

}  // namespace armcal::refinement_test
