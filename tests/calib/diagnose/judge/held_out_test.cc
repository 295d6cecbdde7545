#include "calib/diagnose/judge/held_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "model/effects/effects.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::held_out_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz

// A 2R arm's exact motion of 30 s, whose torque a test changes.
class HeldOutTest : public testing::Test {
 protected:
  HeldOutTest()
      : arm_("2R planar (vertical plane)", 30, .005),
        baseline_(arm_.robot, {}, VectorXd::Constant(2, 10)) {
    tau_ = RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
               .nominal();
    std::mt19937_64 random(2);
    AddNoise(&random, VectorXd::Constant(2, .05), &tau_);
  }

  GapSegment Segment() const { return MakeSegment(arm_.motion, tau_); }

  GapFit Fit(const std::vector<std::string>& of = {},
             const std::vector<GapSegment>& reference = {}) {
    GapFitOptions options;
    options.bandwidth_hz = kBandwidth;
    for (const Effect& effect : Effects()) {
      if (std::count(of.begin(), of.end(), effect.name) > 0) continue;
      options.without.push_back(effect.name);
    }
    GapFit fit(baseline_, options, {Segment()}, reference);
    fit.Choose();
    return fit;
  }
  // Torque as the refitted model predicts it, thinned samples x joints.
  MatrixXd Predicted() {
    const GapFit fit = Fit();
    const HeldOut held_out(fit);
    return held_out.rows().ThinAll({tau_}) - held_out.AllResiduals().refit;
  }
  // rms over the samples that a fold predicts.
  double ChangeIn(int fold, const MatrixXd& change) {
    const std::vector<GapSegment> segments = {Segment()};
    const GapRows rows(segments, kBandwidth, LogPart::Fold(fold));
    double sum = 0;
    int count = 0;
    for (int k = 0; k < rows.num_thin(); ++k) {
      if (!rows.IsInPart(0, k)) continue;
      sum += change.row(k).squaredNorm();
      ++count;
    }
    return std::sqrt(sum / count);
  }

  EffectArm arm_;
  GapBaseline baseline_;
  MatrixXd tau_;
};

// Torque that is wrong in the second tenth, which is of the second fold: what
// is predicted there comes from the other folds and does not follow it.
TEST_F(HeldOutTest, AFoldIsPredictedByTheOthers) {
  const MatrixXd before = Predicted();
  const int tenth = arm_.motion.size() / 10;
  for (int k = tenth + tenth / 4; k < 2 * tenth - tenth / 4; ++k) {
    tau_.row(k).array() += 4;
  }
  const MatrixXd change = Predicted() - before;
  const double own = ChangeIn(1, change);
  EXPECT_GT(ChangeIn(0, change), .05);
  EXPECT_GT(ChangeIn(2, change), .05);
  EXPECT_LT(own, .2 * ChangeIn(0, change));
  EXPECT_LT(own, .2 * ChangeIn(2, change));
}

// What is judged is all of a log but the guards between its tenths, 4 / 6 s
// each, and the bent ends: 3 s less 4 / 6 s of each.
TEST_F(HeldOutTest, AllOfALogIsPredicted) {
  const GapFit fit = Fit();
  const HeldOut held_out(fit);
  const double step = held_out.rows().step(0);
  int rows = 0;
  for (const GapRows::Run& run : held_out.rows().runs(0)) rows += run.size;
  EXPECT_NEAR(rows * step, held_out.rows().time() - 10 * 4 / kBandwidth, .5);
}

// Two and a half times a link's mass and inertia are no error of its own, but a
// payload, which has more parameters: the columns alone prefer the link. Data
// without a fold choose as all of the data do.
TEST_F(HeldOutTest, AFoldChoosesWhatCanBe) {
  const GapSegment reference = Segment();
  RecordedTorque recorded(arm_.robot, baseline_.transitions(), arm_.motion);
  tau_ += arm_.Change(*FindEffect("link_inertia"), 1,
                      VectorXd::Constant(1, 1.5), &recorded);
  const GapFit fit = Fit({"link_inertia", "payload"}, {reference});
  ASSERT_EQ(fit.refined().effects.size(), 1u);
  ASSERT_EQ(fit.refined().effects[0].effect->name, "payload");
  const HeldOut held_out(fit);
  const PlacedEffect payload = {fit.refined().effects[0].effect, -1};
  for (const Confirmation& of_fold : held_out.ConfirmationsOf(0, {payload})) {
    EXPECT_GT(of_fold.explained, 0);
  }
  // The gain of an only effect is all that is removed.
  const GapFigures figures =
      RemovedShareFigures(held_out.SquaresOf(held_out.AllResiduals()), 0, 1);
  const EffectGain gain = held_out.GainOf(0);
  EXPECT_NEAR(gain.value, figures.refit - figures.after, 1e-6 * figures.refit);
  EXPECT_NEAR(gain.value, gain.expected, .1 * gain.expected);
  EXPECT_GT(gain.ci95[0], 0);
}

// The reference was a third as fast, so that what its model leaves may be nine
// times as large in this motion. What is left is told as it is, and so is what
// it may be.
TEST_F(HeldOutTest, TorquesAreToldAsTheyAre) {
  Motion slow = arm_.motion;
  slow.dt *= 3;
  slow.qd /= 3;
  slow.qdd /= 9;
  const GapFit fit = Fit(
      {}, {MakeSegment(slow,
                       RecordedTorque(arm_.robot, baseline_.transitions(), slow)
                           .nominal())});
  const HeldOut held_out(fit);
  const HeldOut::Residuals left = held_out.AllResiduals();
  const MatrixXd rms = held_out.RmsOf(left);
  for (int j = 0; j < 2; ++j) {
    const VectorXd refit = left.refit.col(j);
    EXPECT_NEAR(rms(j, 1), std::sqrt(refit.squaredNorm() / refit.size()),
                .1 * rms(j, 1));
    EXPECT_GT(rms(j, 3), 3 * fit.noise().joints[j].stddev());
  }
}

TEST(Bounded, WhatRunsAwayIsNotMissing) {
  const MatrixXd left =
      Bounded((MatrixXd(1, 3) << .5, INFINITY, -NAN).finished());
  EXPECT_EQ(left(0, 0), .5);
  EXPECT_EQ(left(0, 1), 1e9);
  EXPECT_EQ(left(0, 2), 1e9);
}

}  // namespace armcal::held_out_test
