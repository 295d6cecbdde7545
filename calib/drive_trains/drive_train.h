#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/drive_trains/samples.h"
#include "model/robot/robot.h"

namespace armcal {

// What lies between a joint's motor current i and the torque sensor behind its
// gear. The sensor has what the motor gives less what the drive train takes:
//   torque = K i - I qdd - F qd - (C + m |torque|) sign(qd) - o,
// all on the joint's side of the gear.
struct DriveTrain {
  enum Unknown {
    kTorqueConstant,  // K, N m/A or N/A
    kArmature,        // I, kg m^2 or kg
    kViscous,         // F, N m s/rad or N s/m
    kCoulomb,         // C, N m or N
    kLoadFriction,    // m: by load, as a gear's losses are
    kOffset,          // o, N m or N: of current and sensor together
    kUnknowns
  };

  std::string joint;
  JointType type = JointType::kRevolute;
  // Why nothing is told; empty: something is.
  std::string not_told;
  Eigen::Matrix<double, kUnknowns, 1> value, stddev;
  // Whether the logs tell an unknown apart from the others.
  Eigen::Array<bool, kUnknowns, 1> told;
  double width = 0;    // rad/s or m/s: of the sign, tanh(qd / width)
  double rms = 0;      // A, what is left of the current
  double current = 0;  // A, rms of the current about its mean
};

struct DriveTrains {
  long samples = 0;  // 0: no log has currents beside torques
  std::vector<DriveTrain> joints;
};

// Each joint by itself: no lengths, masses or other joints are in its equation.
// Normal equations with an instrument for the torque (where it is one), weighed
// by Huber's loss first and Tukey's at last, at the width of the sign that
// leaves least. The covariance is the sandwich of their slope and the scores'
// long-run covariance (ScoreCovariance).
DriveTrain FitDriveTrain(const std::vector<DriveTrainSample>& samples,
                         int joint);

// The same of all joints of prepared logs.
DriveTrains EstimateDriveTrains(const Robot& robot, const Progress& progress,
                                const PreparedLogs& logs);

}  // namespace armcal
