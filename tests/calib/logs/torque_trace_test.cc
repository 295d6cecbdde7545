#include "calib/logs/torque_trace.h"

#include <gtest/gtest.h>

#include "tests/fixtures/sample_motion.h"
#include "tests/fixtures/sample_robots.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::torque_trace_test {

// Recorded, two models and what each leaves: the true one leaves nothing but a
// spike, the other one (without gravity's lever) much.
TEST(TorqueTrace, HoldsRecordedPredictedAndTheirDifference) {
  std::mt19937_64 random(4);
  Robot robot = SampleRobot("3R elbow");
  SetRandomInertials(&random, &robot);
  Log log = RecordMotion(RandomMultisine(&random, 3), 20, .004);
  AddTorque(robot, &log);
  log.tau(2000, 1) += 500;
  LogReaderOptions reader;
  reader.joint_names = robot.JointNames();
  reader.want_velocity = reader.want_acceleration = true;
  LogSet logs({WriteFile(LogCsv(log), "log.csv")}, reader, TimeRange());
  PreparationOptions as_recorded;
  as_recorded.remove_spikes = false;
  const ModelParameters parameters(robot, {});
  const Eigen::VectorXd x = parameters.Values(robot);
  const std::vector<TorqueTrace> traces =
      TraceTorques({{"true", parameters, x}, {"half", parameters, .5 * x}}, 500,
                   {}, Prepare(logs, as_recorded));
  ASSERT_EQ(traces.size(), 1u);
  ASSERT_EQ(traces[0].torque.num_signals(), 3 * 5);
  EXPECT_LE(traces[0].torque.bins().size(), 500u);
  // Motion between the log's stamps is interpolated.
  const double tolerance = .01 * ColumnRms(log.tau).maxCoeff();
  int spikes = 0;
  for (const SeriesEnvelope::Bin& bin : traces[0].torque.bins()) {
    for (int j = 0; j < 3; ++j) {
      if (bin.high[9 + j] > 400) {
        ++spikes;
        EXPECT_EQ(j, 1);
        EXPECT_NEAR(bin.high[9 + j], 500, tolerance);
        EXPECT_LE(bin.begin, log.t[2000]);
        EXPECT_GE(bin.end, log.t[2000]);
      } else {
        EXPECT_NEAR(bin.high[9 + j], 0, tolerance);
      }
      EXPECT_NEAR(bin.high[6 + j], .5 * bin.high[3 + j], 1e-9);
      EXPECT_NEAR(bin.low[12 + j], .5 * bin.low[3 + j], tolerance);
    }
  }
  EXPECT_EQ(spikes, 1);
  // What half the torque leaves is the load itself.
  const BinnedProfile& load = traces[0].where[2].load;
  EXPECT_GT(load.size(), 15);
  for (int k = 0; k < load.size(); ++k) {
    if (load.samples(k) == 0) continue;
    EXPECT_NEAR(load.Mean(k)[1], load.begin() + (k + .5) * load.width(),
                load.width() / 2 + tolerance);
  }
  ASSERT_FALSE(traces[0].residual.empty());
  EXPECT_EQ(traces[0].residual.Density().cols(), 6);
}

}  // namespace armcal::torque_trace_test
