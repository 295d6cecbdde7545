#include "calib/diagnose/judge/shared_mean.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/found_effect.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::shared_mean_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using testing::ElementsAre;

FoundEffect OneOf(const std::string& name, double probability,
                  const std::vector<PlacedEffect>& others) {
  FoundEffect found = Found(name, 4, 100);
  found.fitted = {0};
  found.probability = found.any_probability = probability;
  for (const PlacedEffect& other : others) {
    found.any_probability += other.probability;
  }
  found.equivalent = others;
  return found;
}

// Of the four of joint 5, the gain of its drive is no friction.
TEST(AsSharedMean, IsAsProbableAsTheLawsThatHaveIt) {
  const FoundEffect shared =
      AsSharedMean(OneOf("presliding", .4,
                         {{FindEffect("coulomb_friction"), 4, .2},
                          {FindEffect("position_friction"), 4, .05},
                          {FindEffect("torque_gain"), 4, .1}}));
  EXPECT_EQ(shared.effect, FindEffect("coulomb_friction"));
  EXPECT_NEAR(shared.probability, .65, 1e-12);
  EXPECT_NEAR(shared.any_probability, .75, 1e-12);
  std::vector<FoundEffect> others;
  for (const PlacedEffect& other : shared.equivalent) {
    others.push_back(Found(other.effect->name, other.joint, 0));
  }
  EXPECT_THAT(Names(others), ElementsAre("presliding@5", "position_friction@5",
                                         "torque_gain@5"));
}

TEST(AsSharedMean, IsNoneOfOtherJointsOrOtherMeans) {
  const FoundEffect other_joint = AsSharedMean(
      OneOf("presliding", .4, {{FindEffect("coulomb_friction"), 3, .3}}));
  EXPECT_EQ(other_joint.effect, FindEffect("presliding"));
  const FoundEffect other_mean = AsSharedMean(
      OneOf("presliding", .4, {{FindEffect("viscous_friction"), 4, .3}}));
  EXPECT_EQ(other_mean.effect, FindEffect("presliding"));
  EXPECT_EQ(other_mean.probability, .4);
}

// The data have to ask for the mean itself: laws that have one are not it.
TEST(AsSharedMean, IsOneOfThem) {
  const FoundEffect found = AsSharedMean(
      OneOf("presliding", .4, {{FindEffect("position_friction"), 4, .3}}));
  EXPECT_EQ(found.effect, FindEffect("presliding"));
}

// A law and its mean that are fitted beside each other are told apart.
TEST(AsSharedMean, IsNotFittedBesideTheLaw) {
  FoundEffect found =
      OneOf("presliding", .4, {{FindEffect("coulomb_friction"), 4, .3}});
  found.fitted = {0, 1};
  EXPECT_EQ(AsSharedMean(found).effect, FindEffect("presliding"));
}

// Friction of joint 1 is 1 N m more on one side of its range than on the other.
// The law is fitted, and then its mean in its place: as it is where only that
// is considered.
class PutMeansInPlaceTest : public testing::Test {
 protected:
  PutMeansInPlaceTest()
      : arm_("2R planar (vertical plane)", 30, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {
    tau_ = RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
               .nominal();
    std::mt19937_64 random(2);
    AddNoise(&random, VectorXd::Constant(2, .05), &tau_);
    const double middle = arm_.motion.q.col(0).mean();
    const double width = baseline_.transitions()[0].width;
    for (int k = 0; k < arm_.motion.size(); ++k) {
      if (arm_.motion.q(k, 0) < middle) continue;
      tau_(k, 0) += std::tanh(arm_.motion.qd(k, 0) / width);
    }
  }
  GapFit Fit(const std::vector<std::string>& of) {
    GapFitOptions options;
    options.bandwidth_hz = 6;
    for (const Effect& effect : Effects()) {
      if (std::count(of.begin(), of.end(), effect.name) > 0) continue;
      options.without.push_back(effect.name);
    }
    GapFit fit(baseline_, options, {MakeSegment(arm_.motion, tau_)}, {});
    fit.Choose();
    return fit;
  }

  EffectArm arm_;
  GapBaseline baseline_;
  MatrixXd tau_;
};

FoundEffect FirstOf(const std::string& name) {
  FoundEffect found = Found(name, 0, 100);
  found.fitted = {0};
  return found;
}

TEST_F(PutMeansInPlaceTest, FitsTheMean) {
  GapFit fit = Fit({"position_friction", "coulomb_friction"});
  ASSERT_EQ(fit.refined().effects[0].effect->name, "position_friction");
  fit.KeepOnly({0});
  EXPECT_FALSE(PutMeansInPlace({FirstOf("position_friction")}, &fit));
  EXPECT_TRUE(PutMeansInPlace({FirstOf("coulomb_friction")}, &fit));
  fit.KeepOnly({0});
  const GapFit expected = Fit({"coulomb_friction"});
  ASSERT_EQ(fit.refined().effects.size(), 1u);
  ASSERT_EQ(expected.refined().effects.size(), 1u);
  EXPECT_EQ(fit.refined().effects[0].effect->name, "coulomb_friction");
  EXPECT_NEAR(fit.refined().effects[0].p[0], expected.refined().effects[0].p[0],
              .02);
}

}  // namespace armcal::shared_mean_test
