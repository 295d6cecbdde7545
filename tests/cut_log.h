#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "model/trajectory.h"
#include "tests/temp_file.h"

namespace armcal {

// A log of one joint, written to a file and cut into trajectories.

inline double Position(double t) {
  return .7 * std::sin(1.9 * t) + .2 * std::sin(7.3 * t + 1);
}
inline double Torque(double t) {
  return 5 * std::cos(3.1 * t) + std::sin(40 * t);
}
// Noise that depends on the sample alone, in [-1, 1].
inline double Noise(int k) { return std::sin(1e4 * std::sin(k + .5)); }

struct LogFile {
  std::string path;
  Eigen::VectorXd q, tau;  // as written
};

// One joint; rows [begin, end) of `without` are left out.
inline LogFile MakeLog(double duration, double dt,
                       const std::function<double(double)>& q, double noise = 0,
                       std::vector<std::pair<int, int>> without = {},
                       bool rates = false) {
  const int n = static_cast<int>(std::lround(duration / dt));
  LogFile log{"", Eigen::VectorXd(n), Eigen::VectorXd(n)};
  std::string text = rates ? "t,q1,tau1,qd1,qdd1\n" : "t,q1,tau1\n";
  for (int k = 0; k < n; ++k) {
    log.q[k] = q(k * dt) + noise * Noise(k);
    log.tau[k] = Torque(k * dt) + 100 * noise * Noise(k + n);
    bool skip = false;
    for (const auto& [begin, end] : without) skip |= k >= begin && k < end;
    char line[160];
    std::snprintf(line, sizeof(line), "%.6f,%.17g,%.17g%s\n", k * dt, log.q[k],
                  log.tau[k], rates ? ",0.25,-4" : "");
    if (!skip) text += line;
  }
  log.path = WriteFile(text);
  return log;
}

inline std::vector<Trajectory> Cut(const std::string& path,
                                   const TrajectoryOptions& options) {
  LogReaderOptions log_options;
  log_options.joint_names = {"joint1"};
  log_options.want_velocity = log_options.want_acceleration =
      options.bandwidth_hz == 0;
  KeptLog log(path, log_options);
  const TimeBase base = AuditTimeBase(options.crop, &log);
  TrajectoryReader reader(&log, base, options);
  std::vector<Trajectory> result;
  Trajectory t;
  while (reader.Next(&t)) result.push_back(t);
  EXPECT_FALSE(reader.Next(&t));
  EXPECT_EQ(reader.progress(), 1);
  reader.Rewind();
  EXPECT_TRUE(reader.Next(&t));
  EXPECT_EQ(t.q, result.at(0).q);
  return result;
}

inline TrajectoryOptions Bandwidth(double hz, double reach = 0) {
  TrajectoryOptions options;
  options.bandwidth_hz = hz;
  options.reach_s = reach;
  return options;
}

}  // namespace armcal
