#include "model/signals/bandwidth.h"

#include <gtest/gtest.h>

#include <utility>

namespace armcal::bandwidth_test {

using Logs = std::vector<std::pair<double, double>>;  // motion, Hz, and step, s

std::vector<TimeBase> TimeBases(const Logs& logs) {
  std::vector<TimeBase> bases;
  for (const auto& [motion_hz, dt] : logs) {
    bases.emplace_back();
    bases.back().motion_hz = motion_hz;
    bases.back().dt = dt;
  }
  return bases;
}

TEST(DefaultBandwidth, FollowsTheMotionAndTheRate) {
  const auto bandwidth = [](const Logs& logs) {
    return DefaultBandwidth(TimeBases(logs));
  };
  EXPECT_EQ(bandwidth({{.1, .001}}), 8);
  EXPECT_EQ(bandwidth({{.85, .001}}), 8.5);
  EXPECT_EQ(bandwidth({{.7, .001}, {.9, .001}}), 9);
  EXPECT_EQ(bandwidth({{5, .001}}), 20);
  EXPECT_EQ(bandwidth({{5, .02}, {1, .001}}), 10);
  EXPECT_EQ(bandwidth({{0, .1}}), 2);
}

TEST(DiagnosisBandwidth, IsAtLeast10HzWhereTheRateAllows) {
  const auto bandwidth = [](const Logs& logs) {
    return DiagnosisBandwidth(TimeBases(logs));
  };
  EXPECT_EQ(bandwidth({{.1, .001}}), 10);
  EXPECT_EQ(bandwidth({{1.5, .001}}), 15);
  EXPECT_EQ(bandwidth({{.1, .02}}), 6.25);
  EXPECT_EQ(bandwidth({{.1, .001}, {.1, .02}}), 6.25);
}

}  // namespace armcal::bandwidth_test
