#include "calib/logs/log_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "calib/logs/prepared_logs.h"
#include "model/text/input_error.h"
#include "tests/fixtures/cut_log.h"

namespace armcal::log_set_test {

LogReaderOptions OneJoint() {
  LogReaderOptions options;
  options.joint_names = {"joint1"};
  return options;
}

LogSet Open(const std::vector<std::string>& paths, std::size_t memory) {
  return LogSet(LogFiles(paths), OneJoint(), {}, memory);
}

void ExpectSame(const Trajectory& a, const Trajectory& b) {
  EXPECT_EQ(a.t0, b.t0);
  EXPECT_EQ(a.q, b.q);
  EXPECT_EQ(a.qd, b.qd);
  EXPECT_EQ(a.qdd, b.qdd);
  EXPECT_EQ(a.tau, b.tau);
  EXPECT_EQ(a.tau_recorded, b.tau_recorded);
  EXPECT_TRUE((a.standstill == b.standstill).all());
  EXPECT_EQ(a.segment, b.segment);
  EXPECT_EQ(a.core_begin, b.core_begin);
  EXPECT_EQ(a.core_end, b.core_end);
  EXPECT_EQ(a.samples.tau, b.samples.tau);
}

// What all passes give, at both rates.
std::vector<std::pair<int, Trajectory>> Passes(const PreparedLogs& logs) {
  std::vector<std::pair<int, Trajectory>> all;
  const auto visit = [&](int log, const Trajectory& t) {
    all.emplace_back(log, t);
  };
  for (int pass = 0; pass < 2; ++pass) {
    logs.ForEach("", {}, visit);
    logs.ForEachAtFullRate("", {}, visit);
  }
  return all;
}

void ExpectSame(const PreparedLogs& a, const PreparedLogs& b) {
  const auto ours = Passes(a), theirs = Passes(b);
  ASSERT_EQ(ours.size(), theirs.size());
  ASSERT_GT(ours.size(), 3);
  for (size_t k = 0; k < ours.size(); ++k) {
    EXPECT_EQ(ours[k].first, theirs[k].first);
    ExpectSame(ours[k].second, theirs[k].second);
  }
  EXPECT_EQ(a.spikes(), b.spikes());
}

PreparationOptions At(double bandwidth_hz) {
  PreparationOptions options;
  options.bandwidth_hz = bandwidth_hz;
  options.reach_s = .3;
  return options;
}

// One log with uneven steps and a gap, one with spikes.
std::vector<std::string> WriteLogs() {
  const LogFile spiky = MakeLog(30, .004, Position, 1e-4);
  std::string text = "t,q1,tau1,qd1,qdd1\n";
  for (int k = 0; k < 4000; ++k) {
    const double t = .005 * k + (k > 2500 ? 3 : 0) + 1e-3 * Noise(k);
    char line[160];
    std::snprintf(line, sizeof(line), "%.6f,%.9g,%.9g,.5,-1\n", t, Position(t),
                  Torque(t) + (k % 500 == 7 ? 300 : 0));
    text += line;
  }
  return {WriteFile(text, "uneven.csv"), spiky.path};
}

TEST(LogSet, WhatIsKeptIsWhatWouldBeMadeAgain) {
  const auto paths = WriteLogs();
  for (const std::size_t memory : {std::size_t{1} << 28, std::size_t{300000}}) {
    const LogSet kept = Open(paths, memory), made = Open(paths, 0);
    for (const double bandwidth : {5., 0.}) {
      PreparationOptions options = At(bandwidth);
      ExpectSame(Prepare(kept, options), Prepare(made, options));
      EXPECT_EQ(Prepare(kept, options).spikes() > 0, bandwidth > 0);
      // Spikes are not replaced where outliers are listed, none at first.
      for (const std::vector<TorqueOutlier>& first :
           {std::vector<TorqueOutlier>(),
            {{900, 4.4, 0, 1, -7, 9}},
            std::vector<TorqueOutlier>()}) {
        options.outliers = {first, {}};
        ExpectSame(Prepare(kept, options), Prepare(made, options));
      }
    }
  }
}

// Two views of the same logs, used in turns.
TEST(LogSet, AViewStaysAsItWasPrepared) {
  const LogSet logs = Open(WriteLogs(), std::size_t{1} << 28);
  const PreparedLogs first = Prepare(logs, At(5));
  const auto before = Passes(first);
  PreparationOptions options = At(5);
  options.outliers = {{{900, 4.4, 0, 1, -7, 9}}, {}};
  const PreparedLogs second = Prepare(logs, options);
  const auto other = Passes(second), after = Passes(first);
  ASSERT_EQ(before.size(), after.size());
  double moved = 0;
  for (size_t k = 0; k < before.size(); ++k) {
    ExpectSame(before[k].second, after[k].second);
    moved += (before[k].second.tau - other[k].second.tau).norm();
  }
  EXPECT_GT(moved, 1);
  EXPECT_GT(first.spikes(), 0);
  EXPECT_EQ(second.spikes(), 0);
}

TEST(LogSet, StretchesAreOfAView) {
  const auto paths = WriteLogs();
  const LogSet kept = Open(paths, std::size_t{1} << 28), made = Open(paths, 0);
  for (const LogSet::Stretches& stretches : {LogSet::Stretches(),
                                             {{{1, 4}, {6, 9}}, {{2, 21}}},
                                             {{{2, 5}}, {{0, 3}, {3, 8}}},
                                             LogSet::Stretches()}) {
    ExpectSame(Prepare(kept.Within(stretches), At(5)),
               Prepare(made.Within(stretches), At(5)));
    EXPECT_TRUE(kept.stretches().empty());
  }
}

TEST(LogSet, ReadsFilesOnceWhereMemoryAllows) {
  const auto paths = WriteLogs();
  const LogSet logs = Open(paths, std::size_t{1} << 28);
  for (const std::string& path : paths) std::remove(path.c_str());
  EXPECT_GT(Passes(Prepare(logs, At(5))).size(), 3);
}

// Arrays are the same log as their file.
TEST(LogSet, TakesLogsFromMemory) {
  const std::vector<std::string> paths = WriteLogs();
  std::vector<LogSource> arrays;
  for (const std::string& path : paths) {
    LogReaderOptions all = OneJoint();
    all.want_velocity = all.want_acceleration = true;
    arrays.emplace_back(path, ReadWholeLog(path, all));
  }
  for (const std::string& path : paths) std::remove(path.c_str());
  const LogSet from_arrays(arrays, OneJoint(), {});
  const LogSet from_files = Open(WriteLogs(), std::size_t{1} << 28);
  for (const double bandwidth : {5., 0.}) {
    ExpectSame(Prepare(from_arrays, At(bandwidth)),
               Prepare(from_files, At(bandwidth)));
  }
  Log ragged = ReadWholeLog(WriteLogs()[0], OneJoint());
  ragged.tau.conservativeResize(100, 1);
  EXPECT_THAT(
      [&] {
        LogSet({{"ragged", ragged}}, OneJoint(), {});
      },
      testing::Throws<InputError>(testing::Property(
          &InputError::what,
          testing::StartsWith("ragged: array tau: found '100 rows'"))));
}

}  // namespace armcal::log_set_test
