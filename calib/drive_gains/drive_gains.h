#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

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
  // The gain that is known least well, and its relative standard deviation;
  // CHECK `solved`.
  int LeastCertain() const;
  double LargestRelativeStddev() const;
};

}  // namespace armcal
