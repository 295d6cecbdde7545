// Where trajectories begin and end, and what they leave out.
#include <gtest/gtest.h>

#include "model/signals/trajectory.h"
#include "tests/fixtures/cut_log.h"

namespace armcal::trajectory_cuts_test {

// Still from 4.0 to 4.6 s and from 10.0 to 10.4 s (too short), at 100 Hz.
TEST(TrajectoryCuts, MarksStandstill) {
  const auto q = [](double t) {
    const double s = t < 4      ? t
                     : t < 4.6  ? 4
                     : t < 10   ? t - .6
                     : t < 10.4 ? 9.4
                                : t - 1;
    return .1 * s;
  };
  const LogFile log = MakeLog(20, .01, q);
  for (const Trajectory& t : Cut(log.path, Bandwidth(0))) {
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const double time = t.time(k);
      // Derivatives reach two samples.
      if ((time > 3.99 && time < 4.025) || (time > 4.575 && time < 4.61)) {
        continue;
      }
      EXPECT_EQ(t.standstill[k], time > 4 && time < 4.6) << time;
    }
  }
}

TEST(TrajectoryCuts, StandstillAcrossCores) {
  const auto q = [](double t) {
    return t < 15.8 || t > 16.4 ? std::sin(t) : 1.;
  };
  bool marked = false;
  for (const Trajectory& t : Cut(MakeLog(40, .01, q).path, Bandwidth(0))) {
    for (int k = t.core_begin; k < t.core_end; ++k) {
      const bool still = t.time(k) > 15.83 && t.time(k) < 16.37;
      marked |= still;
      EXPECT_LE(still, t.standstill[k]) << t.time(k);
    }
  }
  EXPECT_TRUE(marked);
}

// A hole of 0.24 s ends a segment at 5 Hz (0.05 s) and 1.1 Hz, and is bridged
// at 1 Hz (0.25 s); without a bandwidth three steps decide.
TEST(TrajectoryCuts, SplitsAtGaps) {
  const LogFile log = MakeLog(12, .01, Position, 0, {{500, 523}, {900, 902}});
  for (const double bandwidth : {0.0, 1.1, 5.0}) {
    const auto parts = Cut(log.path, Bandwidth(bandwidth));
    ASSERT_EQ(parts.size(), 2);
    EXPECT_EQ(parts[0].segment, 0);
    EXPECT_EQ(parts[1].segment, 1);
    EXPECT_EQ(parts[1].first_index, 0);
    EXPECT_NEAR(parts[0].time(parts[0].core_end - 1), 4.99, .06);
    EXPECT_NEAR(parts[1].t0, 5.23, 1e-9);
    EXPECT_NEAR(parts[1].time(parts[1].core_end - 1), 11.99, .06);
  }
  const auto bridged = Cut(log.path, Bandwidth(1));
  ASSERT_EQ(bridged.size(), 1);
  EXPECT_NEAR(bridged[0].time(bridged[0].size() - 1), 11.99, .06);
}

TEST(TrajectoryCuts, LeavesOutSegmentsOfTwoSamples) {
  const LogFile log =
      MakeLog(6, .01, Position, 0, {{200, 250}, {252, 300}, {303, 400}});
  const auto parts = Cut(log.path, Bandwidth(5));
  ASSERT_EQ(parts.size(), 3);
  EXPECT_NEAR(parts[0].t0, 0, 1e-9);
  EXPECT_NEAR(parts[1].t0, 3, 1e-9);
  EXPECT_EQ(parts[1].core_end, 3);
  EXPECT_NEAR(parts[2].t0, 4, 1e-9);
}

TEST(TrajectoryCuts, Crops) {
  TrajectoryOptions options = Bandwidth(0);
  options.crop = {2, 7.5};
  const auto parts = Cut(MakeLog(10, .01, Position).path, options);
  ASSERT_EQ(parts.size(), 1);
  EXPECT_EQ(parts[0].size(), 551);
  EXPECT_NEAR(parts[0].t0, 2, 1e-9);
  EXPECT_NEAR(parts[0].q(0, 0), Position(2), 1e-12);
}

}  // namespace armcal::trajectory_cuts_test
