#include "calib/diagnose/candidates/effect_torques.h"

#include <gtest/gtest.h>

#include "model/effects/effects.h"
#include "model/signals/delayed_signal.h"
#include "tests/fixtures/effect_arm.h"
#include "tests/fixtures/gap_segment.h"

namespace armcal::effect_torques_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 6;  // Hz
constexpr double kDelay = .03;    // s

// A log of a robot that gives a third more than its model and lags behind it.
class DelayOfARecordingTest : public testing::Test {
 protected:
  DelayOfARecordingTest()
      : arm_("PUMA560 6R", 20, .01),
        baseline_(arm_.robot, {}, VectorXd::Constant(6, 10)) {
    given_ = RecordedTorque(arm_.robot, baseline_.transitions(), arm_.motion)
                 .nominal() *
             (4. / 3);
    late_ = MakeSegment(arm_.motion, Delayed(given_, kDelay / arm_.motion.dt));
    delay_.effect = FindEffect("delay");
    delay_.p = VectorXd::Constant(1, -kDelay);
  }
  // What a model with that delay leaves of the late log, less what one without
  // leaves of the same log in time; rms over that of the change, worst joint.
  double Error() {
    GapData late({late_}, baseline_, kBandwidth);
    const GapData in_time({MakeSegment(arm_.motion, given_)}, baseline_,
                          kBandwidth);
    const JointRows change =
        EffectTorque(baseline_, arm_.scale, {delay_}, &late);
    double worst = 0;
    for (int j = 0; j < 6; ++j) {
      const VectorXd expected =
          late.residual().col(j) - in_time.residual().col(j);
      const int ends = 20, inner = static_cast<int>(expected.size()) - 2 * ends;
      worst =
          std::max(worst, (change[j] - expected).segment(ends, inner).norm() /
                              expected.segment(ends, inner).norm());
    }
    return worst;
  }

  EffectArm arm_;
  GapBaseline baseline_;
  MatrixXd given_;
  GapSegment late_;
  GapCandidate delay_;
};

TEST_F(DelayOfARecordingTest, IsTakenBackWhateverTheModelHasWrong) {
  EXPECT_LT(Error(), .02);
}

// What was made of the motion has its noise: there the model's torque is moved,
// which is a third too small.
TEST_F(DelayOfARecordingTest, OfReconstructedTorqueIsTheModels) {
  late_.reconstructed_torque = true;
  late_.motion.torque = {};
  EXPECT_GT(Error(), .2);
}

}  // namespace armcal::effect_torques_test
