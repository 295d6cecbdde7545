#include "calib/diagnose/candidates/proposals.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

namespace armcal::proposals_test {

using Eigen::MatrixXd;
using testing::Each;
using testing::Not;

constexpr double kStep = .004, kBandwidth = 10;
constexpr int kSize = 5000;  // samples: 20 s

// A joint that swings as a sum of sines (Hz, rad/s), and what is left of its
// torque: a sine of 3.1 Hz and one of .8 Hz.
std::vector<double> FrequenciesOf(const std::vector<double>& swings) {
  GapSegment segment;
  Motion& motion = segment.motion;
  motion.dt = kStep;
  motion.q.setZero(kSize, 1);
  motion.qd.setZero(kSize, 1);
  MatrixXd left(kSize, 1);
  for (int k = 0; k < kSize; ++k) {
    const double t = motion.time(k);
    for (const double f : swings) {
      motion.q(k, 0) += std::sin(2 * M_PI * f * t) / (2 * M_PI * f);
      motion.qd(k, 0) += std::cos(2 * M_PI * f * t);
    }
    left(k, 0) = std::sin(2 * M_PI * 3.1 * t) + 2 * std::sin(2 * M_PI * .8 * t);
  }
  segment.tau = left;
  segment.still.setConstant(kSize, 1, false);
  const std::vector<GapSegment> segments = {segment};
  GapRows rows(segments, kBandwidth);
  rows.SetNoise(std::vector<Autoregression>(1),
                MatrixXd::Zero(rows.num_thin(), 1));
  return GapProposals(rows, rows.ThinAll({left})).Frequencies(0);
}

MATCHER_P(Near, f, "") { return std::abs(arg - f) < .05; }

// What a pendulum of .8 Hz leaves at .8 Hz is of its state.
TEST(GapProposals, FrequenciesAreNotThoseOfTheMotion) {
  EXPECT_THAT(FrequenciesOf({.13, .21, .34, .47, .61}),
              testing::AllOf(testing::Contains(Near(3.1)),
                             testing::Contains(Near(.8))));
  const std::vector<double> of_pendulum = FrequenciesOf({.8});
  EXPECT_THAT(of_pendulum, testing::Contains(Near(3.1)));
  EXPECT_THAT(of_pendulum, Each(Not(Near(.8))));
}

}  // namespace armcal::proposals_test
