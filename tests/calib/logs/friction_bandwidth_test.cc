#include "calib/logs/friction_bandwidth.h"

#include <gtest/gtest.h>

#include <random>

#include "model/dynamics/joint_term.h"
#include "model/signals/low_pass.h"
#include "model/signals/trajectory.h"

namespace armcal::friction_bandwidth_test {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

constexpr double kStep = .001;  // s

// Of one joint for each standard deviation of white noise, rad.
EncoderNoise Of(const ArrayXd& sigma, const ArrayXd& travel) {
  return {sigma.square() * kStep, ArrayXd::Ones(sigma.size()), travel, {}};
}

// White noise, low-passed and differentiated as logs are, has the velocity
// that is allowed.
TEST(FrictionBandwidth, LetsTheNoiseThroughThatItSays) {
  const double sigma = 5e-5;
  const double hz = FrictionBandwidth(Of(ArrayXd{{sigma}}, ArrayXd{{1}}), 10);
  ASSERT_GT(hz, 10);
  ASSERT_LT(hz, kTorqueBand * 10);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0, sigma);
  MatrixXd q(400000, 1);
  for (Eigen::Index k = 0; k < q.rows(); ++k) q(k, 0) = normal(random);
  const MatrixXd qd = Differentiate(ZeroPhaseLowPass(q, 1 / kStep, hz), kStep);
  const double rms = std::sqrt(qd.squaredNorm() / qd.rows());
  EXPECT_NEAR(rms / (CoulombTransition::kSharpestVelocity / 2), 1, .02);
}

TEST(FrictionBandwidth, IsTheTorquesOfFineEncoders) {
  EXPECT_EQ(FrictionBandwidth(Of(ArrayXd{{1e-9}}, ArrayXd{{1}}), 8),
            kTorqueBand * 8);
  EXPECT_EQ(FrictionBandwidth({}, 8), kTorqueBand * 8);
}

TEST(FrictionBandwidth, IsTheMotionsOfCoarseOnes) {
  EXPECT_EQ(FrictionBandwidth(Of(ArrayXd{{1e-3}}, ArrayXd{{1}}), 8), 8);
}

// The noisiest encoder decides, but for one of a joint that does not move.
TEST(FrictionBandwidth, CountsJointsThatMove) {
  const ArrayXd sigma{{1e-9, 1e-3}};
  EXPECT_EQ(FrictionBandwidth(Of(sigma, ArrayXd{{1, 1}}), 8), 8);
  EXPECT_EQ(FrictionBandwidth(Of(sigma, ArrayXd{{1, 0}}), 8), kTorqueBand * 8);
}

}  // namespace armcal::friction_bandwidth_test
