// A calibration that keeps nothing between passes needs no more memory for a
// long log than for a short one.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>

#include "calib/linear/calibrate_linear.h"
#include "calib/linear/calibration.h"
#include "tests/fixtures/sample_robots.h"

namespace armcal::streaming_long_test {

// 7 joints at 1 kHz: sines, and a torque that has to do with them.
std::string WriteLog(const std::string& name, int minutes) {
  const std::string path = testing::TempDir() + name;
  std::FILE* file = std::fopen(path.c_str(), "w");
  std::fputs("t,q1,q2,q3,q4,q5,q6,q7,tau1,tau2,tau3,tau4,tau5,tau6,tau7\n",
             file);
  for (int k = 0; k < minutes * 60000; ++k) {
    const double t = 1e-3 * k;
    double q[7];
    std::fprintf(file, "%.3f", t);
    for (int j = 0; j < 7; ++j) {
      q[j] = std::sin((1 + 0.3 * j) * t) + 0.4 * std::sin((2.1 + 0.2 * j) * t);
      std::fprintf(file, ",%.6f", q[j]);
    }
    for (const double x : q) {
      std::fprintf(file, ",%.5f", 20 * std::sin(x) + 0.01 * (k % 17));
    }
    std::fputc('\n', file);
  }
  std::fclose(file);
  return path;
}

// Of this process until now, kB.
double PeakMemory() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss);
}

void Calibrate(const std::string& path) {
  const Robot robot = SampleRobot("Panda 7R");
  LogReaderOptions log_options;
  log_options.joint_names = robot.JointNames();
  LogSet training({path}, log_options, {}, 0);
  LinearCalibrationOptions options;
  options.bandwidth_hz = 8;
  EXPECT_TRUE(CalibrateLinear(robot, options, training, nullptr).solved);
}

TEST(Streaming, MemoryDoesNotGrowWithTheLog) {
  const std::string minute = WriteLog("minute.csv", 1);
  const std::string long_log = WriteLog("quarter_of_an_hour.csv", 15);
  Calibrate(minute);
  const double short_peak = PeakMemory();
  Calibrate(long_log);
  EXPECT_LT(PeakMemory(), 1.2 * short_peak)
      << short_peak << " kB for one minute";
  std::remove(minute.c_str());
  std::remove(long_log.c_str());
}

}  // namespace armcal::streaming_long_test
