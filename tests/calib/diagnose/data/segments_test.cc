#include "calib/diagnose/data/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "calib/diagnose/data/rows.h"
#include "tests/fixtures/swing.h"
#include "tests/fixtures/temp_file.h"

namespace armcal::segments_test {

constexpr double kStep = .004;     // s
constexpr double kBandwidth = 10;  // Hz

// Two joints at 1 Hz; the second stands still from 4 to 7 s.
Log Swing(double duration) {
  Log log = RecordMotion(SwingOfTwoJoints(), duration, kStep);
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] < 4 || log.t[k] > 7) continue;
    log.q(k, 1) = .9;
  }
  log.tau = log.qd;
  return log;
}

std::vector<GapSegment> Read(const std::vector<std::string>& texts) {
  std::vector<std::string> paths;
  for (size_t k = 0; k < texts.size(); ++k) {
    paths.push_back(WriteFile(texts[k], std::to_string(k) + ".csv"));
  }
  LogReaderOptions reader;
  reader.joint_names = {"a", "b"};
  reader.want_temperature = true;
  LogSet logs(LogFiles(paths), reader, {});
  return ReadSegments(kBandwidth, {}, logs);
}

// A passive joint, or one whose torque was not recorded, has zeros throughout.
TEST(GapSegments, AskNothingOfJointsWithoutTorque) {
  Log log = Swing(12);
  log.tau.col(0).setZero();
  const auto segments = Read({LogCsv(log)});
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_TRUE(segments[0].still.col(0).all());
  EXPECT_FALSE(segments[0].still.col(1).all());
  const GapRows rows(segments, kBandwidth);
  EXPECT_TRUE(rows.runs(0).empty());
  EXPECT_FALSE(rows.runs(1).empty());
}

// The log without its rows between t0 and t1.
std::string Without(const Log& log, double t0, double t1) {
  Log cut = log;
  std::vector<int> kept;
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] <= t0 || log.t[k] >= t1) kept.push_back(k);
  }
  cut.t = log.t(kept);
  cut.q = log.q(kept, Eigen::all);
  cut.tau = log.tau(kept, Eigen::all);
  return LogCsv(cut);
}

TEST(GapSegments, HoldTheMotionOfTheLog) {
  const Log log = Swing(12);
  const auto segments = Read({LogCsv(log)});
  ASSERT_EQ(segments.size(), 1u);
  const GapSegment& segment = segments[0];
  EXPECT_NEAR(segment.motion.dt, kStep, 1e-6);
  EXPECT_NEAR(segment.size() * kStep, 12, .1);
  // Away from the ends and from joint 2's jolts.
  for (int k = 250; k < segment.size() - 250; ++k) {
    const int at =
        static_cast<int>(std::lround(segment.motion.time(k) / kStep));
    ASSERT_NEAR(segment.motion.q(k, 0), log.q(at, 0), 1e-5);
    ASSERT_NEAR(segment.motion.qd(k, 0), log.qd(at, 0), 1e-3);
    ASSERT_NEAR(segment.motion.qdd(k, 0), log.qdd(at, 0), .05);
    ASSERT_NEAR(segment.tau(k, 0), log.tau(at, 0), 1e-9);
  }
}

// Noise of a thermometer is not warmth of the joint.
TEST(GapSegments, HoldTemperaturesWhereTheyWereRecorded) {
  Log log = Swing(60);
  EXPECT_EQ(Read({LogCsv(log)})[0].motion.temperature.size(), 0);
  log.temperature.resize(log.size(), 2);
  const auto warmth = [](double t) { return 25 - 8 * std::expm1(-t / 20); };
  for (int k = 0; k < log.size(); ++k) {
    const double T = warmth(log.t[k]);
    log.temperature.row(k) << T + (k % 2 ? .5 : -.5), 30;
  }
  const GapSegment segment = Read({LogCsv(log)})[0];
  ASSERT_EQ(segment.motion.temperature.rows(), segment.size());
  for (int k = 0; k < segment.size(); ++k) {
    const auto T = segment.motion.temperature.row(k);
    ASSERT_NEAR(T[0], warmth(segment.motion.time(k)), .1) << k;
    ASSERT_NEAR(T[1], 30, 1e-9);
  }
}

TEST(GapSegments, KnowWhichJointStandsStill) {
  const auto segments = Read({LogCsv(Swing(12))});
  ASSERT_EQ(segments.size(), 1u);
  const GapSegment& segment = segments[0];
  for (int k = 0; k < segment.size(); ++k) {
    const double t = segment.motion.time(k);
    EXPECT_FALSE(segment.still(k, 0)) << t;
    // Its ends are known to a fraction of a second.
    if (std::min(std::abs(t - 4), std::abs(t - 7)) < .3) continue;
    EXPECT_EQ(segment.still(k, 1), t > 4 && t < 7) << t;
  }
}

// Until its bearings slide, friction of a joint that leaves a rest is not told:
// at 4 mrad/s it has moved by 3 mrad after .75 s.
TEST(GapSegments, KnowWhichJointLeavesARest) {
  Log log = Swing(12);
  for (int k = 0; k < log.size(); ++k) {
    const double t = log.t[k];
    if (t > 6 && t <= 8) log.q(k, 1) = .9 - .004 * (t - 6);
  }
  const GapSegment segment = Read({LogCsv(log)}).at(0);
  for (int k = 0; k < segment.size(); ++k) {
    const double t = segment.motion.time(k);
    EXPECT_FALSE(segment.BreaksAway(k, 0)) << t;
    if (std::abs(t - 6) < .15 || std::abs(t - 6.75) < .15) continue;
    EXPECT_EQ(segment.BreaksAway(k, 1), t > 6 && t < 6.75) << t;
  }
  // Neither rows of motion nor of rest.
  const std::vector<GapSegment> segments = {segment};
  const GapRows rows(segments, kBandwidth);
  for (const auto& runs : {rows.runs(1), rows.still_runs(1)}) {
    for (const GapRows::Run& run : runs) {
      for (int k = run.begin; k < run.begin + run.size; ++k) {
        const double t = rows.thin_time(0, k);
        EXPECT_FALSE(t > 6.15 && t < 6.6) << t;
      }
    }
  }
}

// A joint that creeps stands still where its torque was reconstructed from
// commands.
TEST(GapSegments, CreepingStandsStillWhereTorquesAreReconstructed) {
  Log log = Swing(12);
  for (int k = 0; k < log.size(); ++k) {
    if (log.t[k] >= 4 && log.t[k] <= 7) log.q(k, 1) += .002 * (log.t[k] - 5.5);
  }
  const std::string path = WriteFile(LogCsv(log));
  LogReaderOptions reader;
  reader.joint_names = {"a", "b"};
  const auto still = [&] {
    LogSet logs({path}, reader, {});
    const auto segments = ReadSegments(kBandwidth, {}, logs);
    return segments.at(0).still.col(1).count() * segments[0].motion.dt;
  };
  EXPECT_EQ(still(), 0);
  const auto torque = std::make_shared<ReconstructedTorque>();
  torque->tau = log.tau;
  log.tau.resize(0, 0);
  log.qref = log.q;
  WriteFile(LogCsv(log));
  reader.commands_do = true;
  reader.reconstructed_torque[path] = torque;
  EXPECT_NEAR(still(), 3, .3);
}

TEST(GapSegments, EndAtGapsAndLogsAndAreLongEnough) {
  const Log log = Swing(12);
  // 0 to 5 s and 5.5 to 12 s; all of it; 0 to 1.5 s, too short, and the rest.
  const auto segments =
      Read({Without(log, 5, 5.5), LogCsv(log), Without(log, 1.5, 2.5)});
  ASSERT_EQ(segments.size(), 4u);
  const std::vector<int> logs = {0, 0, 1, 2};
  const std::vector<double> begin = {0, 5.5, 0, 2.5},
                            length = {5, 6.5, 12, 9.5};
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(segments[k].log, logs[k]);
    EXPECT_NEAR(segments[k].motion.t0, begin[k], .1) << k;
    EXPECT_NEAR(segments[k].size() * kStep, length[k], .2) << k;
  }
}

}  // namespace armcal::segments_test
