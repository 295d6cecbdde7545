#include "calib/logs/log_set.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/fixtures/cut_log.h"

namespace armcal::log_set_test {

LogSet Open(const std::vector<std::string>& paths, std::size_t memory) {
  LogReaderOptions options;
  options.joint_names = {"joint1"};
  return LogSet(paths, options, {}, memory);
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
std::vector<std::pair<int, Trajectory>> Passes(LogSet* logs) {
  std::vector<std::pair<int, Trajectory>> all;
  const auto visit = [&](int log, const Trajectory& t) {
    all.emplace_back(log, t);
  };
  for (int pass = 0; pass < 2; ++pass) {
    logs->ForEach("", {}, visit);
    logs->ForEachAtFullRate("", {}, visit);
  }
  return all;
}

void ExpectSame(LogSet* a, LogSet* b) {
  const auto ours = Passes(a), theirs = Passes(b);
  ASSERT_EQ(ours.size(), theirs.size());
  ASSERT_GT(ours.size(), 3);
  for (size_t k = 0; k < ours.size(); ++k) {
    EXPECT_EQ(ours[k].first, theirs[k].first);
    ExpectSame(ours[k].second, theirs[k].second);
  }
  EXPECT_EQ(a->spikes(), b->spikes());
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
    LogSet kept = Open(paths, memory), made = Open(paths, 0);
    for (const double bandwidth : {5., 0.}) {
      for (LogSet* logs : {&kept, &made}) logs->Prepare(bandwidth, .3);
      ExpectSame(&kept, &made);
      EXPECT_EQ(kept.spikes() > 0, bandwidth > 0);
      for (LogSet* logs : {&kept, &made}) logs->TakeOut({{}, {}});
      ExpectSame(&kept, &made);  // spikes are no longer replaced
      for (LogSet* logs : {&kept, &made}) {
        logs->TakeOut({{{900, 4.4, 0, 1, -7, 9}}, {}});
      }
      ExpectSame(&kept, &made);
      for (LogSet* logs : {&kept, &made}) logs->TakeOut({{}, {}});
      ExpectSame(&kept, &made);
    }
  }
}

TEST(LogSet, StretchesMayChangeBetweenPasses) {
  const auto paths = WriteLogs();
  LogSet kept = Open(paths, std::size_t{1} << 28), made = Open(paths, 0);
  for (LogSet* logs : {&kept, &made}) logs->Prepare(5, .3);
  for (const LogSet::Stretches& stretches : {LogSet::Stretches(),
                                             {{{1, 4}, {6, 9}}, {{2, 21}}},
                                             {{{2, 5}}, {{0, 3}, {3, 8}}},
                                             LogSet::Stretches()}) {
    for (LogSet* logs : {&kept, &made}) logs->Keep(stretches);
    ExpectSame(&kept, &made);
  }
}

TEST(LogSet, ReadsFilesOnceWhereMemoryAllows) {
  const auto paths = WriteLogs();
  LogSet logs = Open(paths, std::size_t{1} << 28);
  for (const std::string& path : paths) std::remove(path.c_str());
  logs.Prepare(5, .3);
  EXPECT_GT(Passes(&logs).size(), 3);
}

}  // namespace armcal::log_set_test
