// What files without a law have in its stead, against what the law's torque is
// worked out to be in the mean.

#include "calib/diagnose/candidates/law_share.h"

#include <gtest/gtest.h>

#include "tests/fixtures/effect_arm.h"

namespace armcal::law_share_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz
constexpr double kDuration = 20;  // s

class LawShare : public testing::Test {
 protected:
  LawShare()
      : arm_("2R planar (vertical plane)", kDuration, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {}

  // Of an effect on joint 2, along a log in which joints are that much warmer
  // than usual (K, one entry per sample; empty: not recorded).
  CarriedEffect Of(const std::string& name, const VectorXd& p,
                   const VectorXd& warmth = {}) {
    GapSegment segment;
    segment.motion = arm_.motion;
    if (warmth.size() > 0) {
      segment.motion.temperature = warmth.replicate(1, 2);
      segment.motion.usual_temperature = VectorXd::Zero(2);
    }
    segment.tau =
        RecordedTorque(arm_.robot, baseline_.transitions(), segment.motion)
            .nominal();
    segment.still.setConstant(segment.size(), 2, false);
    GapData data({segment}, baseline_, kBandwidth);
    const Autoregression white = FitAutoregression(
        {VectorXd::LinSpaced(200, 1, 200).array().cos().matrix()}, false);
    data.SetNoise({white, white});
    GapCandidate found;
    found.effect = FindEffect(name);
    found.joint = 1;
    found.p = p;
    CorrectedRobot corrected = MakeCorrectedRobot(
        baseline_, VectorXd::Zero(baseline_.size()), {found}, arm_.scale);
    SetLawShares(baseline_, &data, &corrected);
    return corrected.effects[0];
  }

  // From 0 evenly to this at the end.
  VectorXd Rising(double end) const {
    return VectorXd::LinSpaced(arm_.motion.size(), 0, end);
  }

  EffectArm arm_;
  GapBaseline baseline_;
};

// Friction of a joint that is 10 K warmer all the time is less by the 1 -
// exp(-.2) of viscous .8 and the 1 - exp(-.1) of Coulomb friction 1.5.
TEST_F(LawShare, OfWarmFrictionIsWhatItFalls) {
  const CarriedEffect effect =
      Of("thermal_friction", Eigen::Vector3d(.02, .01, 60),
         VectorXd::Constant(arm_.motion.size(), 10));
  EXPECT_NEAR(ShareOf(effect, JointTerm::kViscous), .8 * std::expm1(-.2), 1e-6);
  EXPECT_NEAR(ShareOf(effect, JointTerm::kCoulomb), 1.5 * std::expm1(-.1),
              1e-6);
  EXPECT_EQ(ShareOf(effect, JointTerm::kOffset), 0);
}

// Its mean is about that at the mean warmth, as the joint moves alike all the
// time.
TEST_F(LawShare, OfFrictionThatFallsIsItsMean) {
  const CarriedEffect effect =
      Of("thermal_friction", Eigen::Vector3d(.02, .01, 60), Rising(20));
  EXPECT_NEAR(ShareOf(effect, JointTerm::kViscous), .8 * std::expm1(-.2),
              .1 * .15);
  EXPECT_NEAR(ShareOf(effect, JointTerm::kCoulomb), 1.5 * std::expm1(-.1),
              .1 * .14);
}

// A bias that grows evenly to .5 N m is half of that in the mean.
TEST_F(LawShare, OfADriftIsHalfItsEnd) {
  const CarriedEffect effect =
      Of("time_drift", Eigen::Vector2d(.5, 1e4 * kDuration));
  EXPECT_NEAR(ShareOf(effect, JointTerm::kOffset), .25, .005);
}

// Bristles that give way at once are Coulomb friction.
TEST_F(LawShare, OfStiffBristlesIsCoulombFriction) {
  const CarriedEffect effect = Of("presliding", Eigen::Vector2d(.7, 1e-4));
  EXPECT_NEAR(ShareOf(effect, JointTerm::kCoulomb), .7, .02);
  EXPECT_NEAR(ShareOf(effect, JointTerm::kViscous), 0, .02);
}

// What every format has needs nothing in its stead, and what has no mean has
// none.
TEST_F(LawShare, IsOfLawsAlone) {
  EXPECT_FALSE(HasShare(Of("coulomb_friction", VectorXd::Constant(1, .7))));
  EXPECT_FALSE(HasShare(Of("armature", VectorXd::Constant(1, .1))));
  EXPECT_FALSE(HasShare(Of("torque_gain", VectorXd::Constant(1, .1))));
}

}  // namespace armcal::law_share_test
