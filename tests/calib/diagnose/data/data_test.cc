#include "calib/diagnose/data/data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fixtures/gap_segment.h"
#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::data_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Friction that changes sign has extra variance, and where torques are
// reconstructed it reaches from four samples before to four after.
TEST(GapData, GivesReversalsOfReconstructedTorquesMoreVariance) {
  std::mt19937_64 random(1);
  Robot robot = SampleRobot("3R elbow");
  for (Link& link : robot.links) link.joint.coulomb = 1.5;
  Log log = RecordMotion(RandomMultisine(&random, 3), 20, .004);
  log.tau = MatrixXd::Zero(log.size(), 3);
  const GapBaseline baseline(robot, {}, VectorXd::Constant(3, 10));
  const auto extra_stddev = [&](bool reconstructed) {
    GapSegment segment = MakeSegment(log);
    segment.reconstructed_torque = reconstructed;
    GapData data({segment}, baseline, 8);
    data.SetNoise(std::vector<Autoregression>(3));
    MatrixXd extra_stddev(data.rows().num_thin(), 3);
    for (int k = 0; k < extra_stddev.rows(); ++k) {
      for (int j = 0; j < 3; ++j) {
        extra_stddev(k, j) = std::sqrt(data.rows().variance(j, k) - 1);
      }
    }
    return extra_stddev;
  };
  const MatrixXd recorded = extra_stddev(false),
                 reconstructed = extra_stddev(true);
  EXPECT_GT(recorded.maxCoeff(), .01);
  for (int k = 4; k + 4 < reconstructed.rows(); ++k) {
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(reconstructed(k, j),
                  recorded.col(j).segment(k - 4, 9).maxCoeff(), 1e-6);
    }
  }
}

}  // namespace armcal::data_test
