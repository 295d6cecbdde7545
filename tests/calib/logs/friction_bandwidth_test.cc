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
  EncoderNoise noise;
  noise.slow_density = sigma.square() * kStep;
  noise.travel = travel;
  return noise;
}

// Root mean squares of white noise, low-passed as logs are, and of its rate.
TEST(FrictionBandwidth, LetsTheNoiseThroughThatItSays) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  MatrixXd q(400000, 1);
  for (Eigen::Index k = 0; k < q.rows(); ++k) q(k, 0) = normal(random);
  const auto rms = [](const MatrixXd& x) {
    return std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
  };
  const auto passed = [&](double sigma, double hz) -> MatrixXd {
    return sigma * ZeroPhaseLowPass(q, 1 / kStep, hz);
  };
  const double fine = 5e-5, coarse = 3e-4;
  const FrictionBand of_fine = FrictionBandwidth(Of({{fine}}, {{1}}), 10);
  const FrictionBand of_coarse = FrictionBandwidth(Of({{coarse}}, {{1}}), 5);
  for (const double hz : {of_fine.velocity_hz, of_coarse.position_hz}) {
    ASSERT_GT(hz, 10);
    ASSERT_LT(hz, 20);
  }
  EXPECT_NEAR(rms(Differentiate(passed(fine, of_fine.velocity_hz), kStep)),
              CoulombTransition::kSharpestVelocity / 2, 1e-5);
  EXPECT_NEAR(rms(passed(coarse, of_coarse.position_hz)),
              CoulombTransition::kSharpestDisplacement / 2, 1e-6);
}

TEST(FrictionBandwidth, IsTheTorquesOfFineEncoders) {
  for (const EncoderNoise& noise : {Of({{1e-9}}, {{1}}), EncoderNoise()}) {
    const FrictionBand band = FrictionBandwidth(noise, 8);
    EXPECT_EQ(band.position_hz, kTorqueBand * 8);
    EXPECT_EQ(band.velocity_hz, kTorqueBand * 8);
  }
}

TEST(FrictionBandwidth, IsTheMotionsOfCoarseOnes) {
  const FrictionBand band = FrictionBandwidth(Of({{1e-2}}, {{1}}), 8);
  EXPECT_EQ(band.position_hz, 8);
  EXPECT_EQ(band.velocity_hz, 8);
}

// The noisiest encoder decides, but for one of a joint that does not move.
TEST(FrictionBandwidth, CountsJointsThatMove) {
  const ArrayXd sigma{{1e-9, 1e-3}};
  EXPECT_EQ(FrictionBandwidth(Of(sigma, {{1, 1}}), 8).velocity_hz, 8);
  EXPECT_EQ(FrictionBandwidth(Of(sigma, {{1, 0}}), 8).velocity_hz,
            kTorqueBand * 8);
}

}  // namespace armcal::friction_bandwidth_test
