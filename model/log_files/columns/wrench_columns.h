#pragma once

#include <string>
#include <vector>

#include "model/log_files/columns/log_columns.h"

namespace armcal {

// A force-torque sensor's columns, in their order: forces (N), then torques
// (N m), in the axes of the sensor.
constexpr int kWrenchColumns = 6;
constexpr const char* kWrenchNames[kWrenchColumns] = {"fx", "fy", "fz",
                                                      "tx", "ty", "tz"};
// What an array of them is called, a row per time.
constexpr char kWrenchArray[] = "wrench";

// The six columns, or none. Their names are those above, or end with the words
// force or torque and x, y or z, before which stand nothing but the names of a
// wrench and of its topic, the same for all six: "force_x",
// "/ft_sensor/wrench/torque/z". Units in brackets are [N] [mN] [kN] [Nm]
// [N m] [mNm] [kNm].
//
// Throws InputError with the missing names where only some of the six are
// there, where two sensors are, and where a unit is another. Columns tx, ty, tz
// without any force are left alone: other programs call positions so.
std::vector<LogColumn> FindWrench(const std::string& file,
                                  const LogColumns& columns);

}  // namespace armcal
