#include "calib/diagnose/judge/moved.h"

#include <gmock/gmock.h>

#include <cmath>

#include "calib/diagnose/candidates/law_share.h"
#include "calib/diagnose/judge/testability.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::moved_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz

// A fit to a 2R arm's exact motion, whose joint 2 may stand still.
class GapFitTest : public testing::Test {
 protected:
  GapFitTest()
      : arm_("2R planar (vertical plane)", 30, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {}

  // With `more` torque beside the truth's, samples x n.
  void Fit(const Robot& truth, double noise, const MatrixXd& more = {}) {
    MatrixXd tau =
        RecordedTorque(truth, baseline_.transitions(), arm_.motion).nominal();
    if (more.size() > 0) tau += more;
    AddNoise(&random_, VectorXd::Constant(2, noise), &tau);
    GapSegment segment = MakeSegment(arm_.motion, tau);
    segment.still.col(1).setConstant(stands_);
    GapFitOptions options;
    options.bandwidth_hz = kBandwidth;
    fit_.emplace(baseline_, options, std::vector<GapSegment>{segment},
                 std::vector<GapSegment>());
    fit_->Choose();
  }
  std::string WhyNot(const std::string& effect,
                     const std::string& joint) const {
    for (const UntestableEffect& one : ListUntestable(*fit_, found_)) {
      if (one.effect == effect && one.joint == joint) return one.why;
    }
    return "";
  }

  EffectArm arm_;
  GapBaseline baseline_;
  std::mt19937_64 random_{2};
  bool stands_ = false;
  std::optional<GapFit> fit_;
  std::vector<FoundEffect> found_;
};

// Three standard deviations of the file's 5 %.
TEST_F(GapFitTest, WhatIsFarFromTheFileIsListed) {
  Robot truth = arm_.robot;
  truth.links[1].joint.viscous *= 1.15;
  Fit(truth, .05);
  const auto moved = ListMoved(*fit_, fit_->refined().baseline, {});
  ASSERT_FALSE(moved.empty());
  EXPECT_EQ(moved[0].name, "joint2.viscous");
  EXPECT_EQ(moved[0].unit, "N m s/rad");
  EXPECT_DOUBLE_EQ(moved[0].nominal, .8);
  EXPECT_NEAR(moved[0].value, .92, 4 * moved[0].stddev);
  EXPECT_LT(moved[0].stddev, .02);
  EXPECT_NEAR(moved[0].deviations, 3, .6);
}

TEST_F(GapFitTest, WhatIsAsTheFileSaysIsNot) {
  Fit(arm_.robot, .05);
  EXPECT_THAT(ListMoved(*fit_, fit_->refined().baseline, {}),
              testing::IsEmpty());
}

// Coulomb friction of 1.5 N m doubled by bristles that bend over so short a way
// that nearly all of the second half is there along the motion.
TEST_F(GapFitTest, FrictionOfALawIsAPartOfIt) {
  baseline_.FreeDays();
  RecordedTorque recorded = arm_.Recorded();
  Fit(arm_.robot, .05,
      arm_.Change(*FindEffect("presliding"), 1, Eigen::Vector2d(1.5, .004),
                  &recorded));
  CorrectedRobot corrected = MakeCorrectedRobot(
      baseline_, fit_->model_after(), fit_->refined().effects, fit_->scale());
  SetLawShares(baseline_, fit_->data(), &corrected);
  ASSERT_EQ(corrected.effects.size(), 1u);
  const auto moved = ListMoved(*fit_, fit_->model_after(), corrected.effects);
  ASSERT_FALSE(moved.empty());
  EXPECT_EQ(moved[0].name, "joint2.coulomb");
  EXPECT_DOUBLE_EQ(moved[0].nominal, 1.5);
  EXPECT_GT(moved[0].value, 2.5);
  EXPECT_LT(moved[0].value, 3 + 4 * moved[0].stddev);
  EXPECT_LT(moved[0].stddev, .1);
}

TEST_F(GapFitTest, AJointThatStandsShowsNothing) {
  stands_ = true;
  Fit(arm_.robot, .05);
  EXPECT_EQ(WhyNot("stribeck", "joint2"), "the joint does not move");
  EXPECT_EQ(WhyNot("stribeck", "joint1"), "");
}

// Noise of less than a hundredth of the torque of a light joint, and of more
// than that torque.
TEST_F(GapFitTest, NoiseHidesEffects) {
  Fit(arm_.robot, .05);
  EXPECT_EQ(WhyNot("torque_ripple", "joint2"), "");
  EXPECT_EQ(WhyNot("load_friction", "joint2"), "");
  Fit(arm_.robot, 20);
  EXPECT_THAT(WhyNot("torque_ripple", "joint2"), testing::HasSubstr("noise"));
  EXPECT_THAT(WhyNot("load_friction", "joint2"), testing::HasSubstr("noise"));
}

// One that matters would hide; that one is larger, and no contradiction.
TEST_F(GapFitTest, WhatWasFoundIsNotUntestable) {
  Fit(arm_.robot, 20);
  found_.resize(1);
  found_[0].effect = FindEffect("torque_ripple");
  found_[0].joint = 1;
  EXPECT_EQ(WhyNot("torque_ripple", "joint2"), "");
  EXPECT_THAT(WhyNot("torque_ripple", "joint1"), testing::HasSubstr("noise"));
  EXPECT_THAT(WhyNot("load_friction", "joint2"), testing::HasSubstr("noise"));
}

}  // namespace armcal::moved_test
