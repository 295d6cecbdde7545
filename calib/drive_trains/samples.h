#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "calib/logs/prepared_logs.h"

namespace armcal {

// Speeds over which friction may change its sign, rad/s or m/s: tanh(qd / w).
inline constexpr std::array<double, 14> kSignWidths = {
    .001, .0015, .0022, .0033, .005, .0074, .011,
    .017, .025,  .037,  .056,  .084, .13,   .2};

// What the motors were given at an instant, what the joints' torque sensors,
// which are behind the gears, measured, and what lies between them. All of it
// is low-passed at one bandwidth: what holds between signals holds between
// these.
struct DriveTrainSample {
  int log = 0;
  bool follows = false;     // the sample before it, without a gap
  Eigen::VectorXd current;  // A, n entries
  Eigen::VectorXd torque;   // N m or N
  // The torque one period of the bandwidth before and after, their mean: it
  // goes with the torque and has other noise.
  Eigen::VectorXd torque_beside;
  Eigen::VectorXd qd, qdd;  // rad/s or m/s, rad/s^2 or m/s^2
  // n x kSignWidths: the sign of the velocity, and |torque| times that.
  Eigen::MatrixXd sign, loaded_sign;
  // The latter of torque_beside.
  Eigen::MatrixXd loaded_sign_beside;
};

// Those of all logs that have motor currents beside torques (LogReaderOptions::
// want_current), thinned to `most` (ThinnedSamples).
std::vector<DriveTrainSample> GatherDriveTrains(const Progress& progress,
                                                const PreparedLogs& logs,
                                                long most = 1 << 13);

}  // namespace armcal
