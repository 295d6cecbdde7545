#pragma once

#include <string>
#include <vector>

#include "model/log_files/columns/log_columns.h"

namespace armcal {

// What the columns of a table hold that are found by their names alone.
enum class ColumnUnit {
  kLength,  // m, or mm where the name ends with [mm]
  kAngle,   // rad, or degrees where it ends with [deg]
  kNone     // no unit is taken
};

// All columns of `names`, in their order, or none. Throws InputError where only
// some are there, one is there twice, or a unit is not one of these.
std::vector<LogColumn> FindNamed(const std::string& file,
                                 const LogColumns& columns,
                                 const std::vector<std::string>& names,
                                 ColumnUnit unit);

}  // namespace armcal
