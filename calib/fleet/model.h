#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/numerics/mixed_model.h"

namespace armcal {

// A parameter of a unit that lies further from the fleet's than the spread of
// the units and the data's noise make it.
struct FleetOutlier {
  int unit;
  int parameter;
  double deviation;  // from the fleet's, if no more than the named are off
  double stddev;
  double sigmas;  // of the test that found it
};

struct FleetOptions {
  // How often a fleet without outliers (without drift) has one named.
  double false_alarms = 0.01;
  bool drift = true;  // fitted, where times differ
};

// What units of one type share and how they differ, by the mixed model.
struct FleetFit {
  double reference_time = 0;  // s, the logs' mean
  bool has_drift = false;
  int rounds = 0;  // until the same units were left out
  bool settled = false;
  Eigen::VectorXd mean, mean_stddev;    // at the reference time
  std::vector<bool> seen;               // per parameter: all logs determine it
  Eigen::VectorXd drift, drift_stddev;  // per s
  std::vector<bool> drifts;             // significant
  Eigen::VectorXd spread;               // square roots of T
  // units x parameters, at the time of a unit's last log; a unit's own data
  // alone, and with what the fleet tells (posterior of a Gaussian).
  Eigen::MatrixXd unit, unit_stddev;
  Eigen::VectorXd unit_time;
  std::vector<FleetOutlier> outliers;
  std::vector<bool> left_out;  // of mean, drift and spread: out of the ordinary
};

// The mixed model's mean, drift and T without units that are out of the
// ordinary, so that these do not widen what they are judged by. A unit is
// tested parameter by parameter, by the score of a deviation of this parameter
// alone, with Student's t for the number of units; the level is shared by all
// tests (Bonferroni). Its deviations are then named one after the other, each
// given the ones before.
FleetFit FitFleet(const std::vector<UnitEvidence>& evidence, int units,
                  const FleetOptions& options);

}  // namespace armcal
