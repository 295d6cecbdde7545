#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/force_torque/sensor.h"

namespace armcal {

// A stretch in which more than its load acts on a force-torque sensor.
struct ForceTorqueContact {
  int log = 0;
  double begin = 0, end = 0;  // s since the log's first row
  double force = 0;           // N, the largest beside the load's
};

// What a force-torque sensor tells of logs beside those of a reference: how
// much more is carried, and when something is touched.
struct ForceTorqueChange {
  ForceTorqueSensor before, now;  // of the reference, and of the logs
  // kg, now less before; NaN where one of them is not told.
  double mass = 0, mass_stddev = 0;
  std::vector<ForceTorqueContact> contacts;

  bool is_told() const { return before.solved && now.solved; }
};

// Both have samples. Each estimate has its own bias, which may have been set to
// zero in between. A contact is where the six residuals of the logs' own
// estimate, in units of their noise, are longer than 6.2 (one in 10^6 normal
// ones) and than twice the 99 % quantile of the reference's, for .05 s or more;
// those less than .25 s apart are one.
ForceTorqueChange CompareForceTorque(
    const std::vector<ForceTorqueSample>& before,
    const std::vector<ForceTorqueSample>& now);

// `force_torque_sensor` of diagnosis.json (docs/diagnose.md); logs by name.
nlohmann::json ForceTorqueJson(const ForceTorqueChange& change,
                               const std::vector<std::string>& logs);

// One or two lines for people.
std::string ForceTorqueText(const ForceTorqueChange& change);

}  // namespace armcal
