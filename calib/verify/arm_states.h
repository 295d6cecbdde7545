#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "calib/logs/prepared_logs.h"
#include "model/robot/robot.h"

namespace armcal {

// Motion of an arm at an instant, n entries each.
struct ArmState {
  Eigen::VectorXd q;    // rad or m
  Eigen::VectorXd qd;   // rad/s or m/s
  Eigen::VectorXd qdd;  // rad/s^2 or m/s^2
};

// States within the joints' limits of position and speed; where the robot has
// none, within half a turn or 1 m and 2 rad/s or 0.5 m/s. Accelerations up to
// 10 rad/s^2 or 3 m/s^2. The same seed gives the same states.
std::vector<ArmState> RandomStates(const Robot& robot, int count,
                                   std::uint64_t seed);

// At most `count` samples of logs, evenly spread over all of them.
class EvenSamples {
 public:
  EvenSamples(int count, const PreparedLogs& logs);

  // The rows of a stretch's core that are among them. Stretches come in the
  // order of PreparedLogs::ForEach().
  std::vector<int> In(int log, const Trajectory& trajectory);

 private:
  int count_;
  std::vector<TimeBase> time_bases_;
  double step_;
  double passed_ = 0;  // samples
  int chosen_ = 0;
};

// At most `count` states of the logs' motion, evenly spread.
std::vector<ArmState> LoggedStates(int count, const Progress& progress,
                                   const PreparedLogs& logs);

}  // namespace armcal
