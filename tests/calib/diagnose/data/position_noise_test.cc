#include "calib/diagnose/data/position_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "calib/closed_loop/commanded_torque.h"
#include "calib/diagnose/data/data.h"
#include "calib/diagnose/data/segments.h"
#include "model/log_files/log_writer.h"
#include "tests/fixtures/commanded_arm.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::position_noise_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBandwidth = 10;  // Hz

// Simbody's arm as a diagnosis reads it, its robot known.
class GapPositionNoiseTest : public testing::Test {
 protected:
  GapPositionNoiseTest() : truth_(CommandedTruth(3)) {}

  std::vector<GapSegment> Read(Encoder encoder, bool reconstructed) {
    ControllerOptions controller = CommandedController(truth_);
    controller.feedforward = Feedforward::kInverseDynamics;
    CommandedLog commanded = RecordCommands(truth_, controller, 20, encoder);
    LogReaderOptions reader;
    reader.joint_names = truth_.JointNames();
    if (reconstructed) {
      commanded.log.tau.resize(0, 0);
      reader.commands_do = true;
    }
    const std::string path = WriteFile(LogText(commanded.log));
    if (reconstructed) {
      controller.delay += kCommandDelay;
      reader.reconstructed_torque[path] =
          std::make_shared<const ReconstructedTorque>(ReconstructTorque(
              truth_, controller, commanded, commanded.log.t, 1));
    }
    LogSet logs({path}, reader, {});
    return ReadSegments(kBandwidth, {}, logs);
  }
  GapBaseline Baseline() const {
    return {truth_, {}, VectorXd::Constant(3, 10)};
  }

  Robot truth_;
};

// The robot explains its log but for noise, away from where friction turns.
TEST_F(GapPositionNoiseTest, IsWhatTheTruthLeaves) {
  for (const Encoder encoder : {kUsualEncoder, kCoarseEncoder}) {
    const GapBaseline baseline = Baseline();
    const GapData data(Read(encoder, true), baseline, kBandwidth);
    const GapRows& rows = data.rows();
    const GapNoise noise = NoiseOfPositions(baseline, rows);
    EXPECT_EQ(noise.source, NoiseFloor::kPositions);
    ASSERT_EQ(noise.joints.size(), 3u);
    const MatrixXd left = data.ResidualWith(VectorXd::Zero(baseline.size()));
    const MatrixXd qd = rows.Pick(0, rows.segments()[0].motion.qd);
    for (int j = 0; j < 3; ++j) {
      double sum = 0;
      int count = 0;
      for (const int k : rows.SampleOfRow(j)) {
        if (std::abs(qd(k, j)) < .4) continue;
        sum += left(k, j) * left(k, j);
        ++count;
      }
      ASSERT_GT(count, 50);
      const double ratio = std::sqrt(sum / count) / noise.joints[j].stddev();
      EXPECT_GT(ratio, .6) << j;
      EXPECT_LT(ratio, 1.5) << j;
    }
  }
}

TEST_F(GapPositionNoiseTest, GrowsWithTheEncoders) {
  const auto stddev = [&](Encoder encoder) {
    const GapBaseline baseline = Baseline();
    const auto segments = Read(encoder, true);
    const GapRows rows(segments, kBandwidth);
    return NoiseOfPositions(baseline, rows).joints.at(1).stddev();
  };
  EXPECT_NEAR(stddev({1e-4, 0}) / stddev({1e-5, 0}), 10, 2);
  EXPECT_LT(stddev({0, 0}), 1e-3 * stddev({1e-5, 0}));
}

TEST_F(GapPositionNoiseTest, RecordedTorquesHaveNone) {
  std::vector<GapSegment> segments = Read(kUsualEncoder, true);
  EXPECT_TRUE(HaveNoiseOfPositions(segments));
  segments.push_back(Read(kUsualEncoder, false).at(0));
  EXPECT_FALSE(HaveNoiseOfPositions(segments));
}

}  // namespace armcal::position_noise_test
