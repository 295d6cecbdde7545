#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "calib/linear_calibration.h"
#include "calib/log_set.h"
#include "model/robot.h"

namespace armcal {

// A joint's torque per current, on the motor side where gear ratios are given.
struct DriveGain {
  std::string name;  // the joint's
  std::string unit;  // "N m/A", "N/A" of a prismatic joint
  double value;      // NaN where not identifiable
  double stddev;     // infinite where not identifiable
  bool identifiable;
  std::string reason;  // why not
};

// A coordinate of the payload's centre of mass in the last link's frame, m.
struct PayloadCoordinate {
  double value;   // NaN where not identifiable
  double stddev;  // infinite where not identifiable
  bool identifiable;
};

struct DriveGains {
  // Whether all gains are identifiable.
  bool solved = false;
  std::string reason;  // "solved", or why not, in one sentence
  std::vector<DriveGain> gains;
  // Of the gains, n x n; entries of those not identifiable are 0.
  Eigen::MatrixXd covariance;
  double payload_mass = 0;             // kg, as given
  std::vector<PayloadCoordinate> com;  // x, y, z

  std::string covariance_method;
  Eigen::VectorXd noise;       // per joint, of the equations, A; 0: left out
  std::vector<long> outliers;  // per joint: equations Huber weighs below 1/2
  long equations = 0;          // per joint
  int passes = 0;              // over the logs
  double bandwidth_hz = 0;

  // One per joint; CHECKs `solved`.
  std::vector<double> TorqueConstants() const;
};

// Estimates every joint's torque per current from logs of the bare arm and logs
// of the same arm with a payload of known mass fixed to the last link, its
// centre of mass and inertia unknown (after Gautier and Briot, J. Dyn. Syst.
// Meas. Control 136, 2014, who take total least squares):
//   i_j = (U_j x + U_Lj x_L) / K_j + error,
// in weak form, errors in the currents. That the joints share parameters x (the
// mass matrix is symmetric: action is reaction) ties their gains to each
// other; the payload's mass alone sets their common scale, as the currents of a
// bare arm show only products of gain and inertia. Friction, offset and
// armature of a joint are its own: they neither help nor harm.
//
// Both log sets are read as currents with torque constants of 1. `payload` may
// be null: then nothing is identifiable, and `reason` says so. A gain counts as
// identifiable where its inverse is three standard deviations clear of 0. Of
// `options`, identification, solver and geometry are not looked at: the lengths
// are those of the file. Bad input throws InputError.
DriveGains EstimateDriveGains(const Robot& robot,
                              const LinearCalibrationOptions& options,
                              double payload_mass, LogSet* bare,
                              LogSet* payload);

}  // namespace armcal
