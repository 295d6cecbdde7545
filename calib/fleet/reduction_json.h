#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "calib/fleet/reduction.h"
#include "calib/numerics/json_value.h"

namespace armcal {

// What is common to reduced logs, as it is stored and compared; and what is
// known of one of them beside its triangles.
nlohmann::json ToJson(const ReductionModel& model);
nlohmann::json ToJson(const ReducedLog& log);

// The other way. Throws InputError. `read` gives the next upper triangle of
// this many columns, the right side's among them.
using ReadTriangle = std::function<Eigen::MatrixXd(int columns)>;
ReductionModel ReadReductionModel(const JsonValue& entry);
ReducedLog ReadReducedLog(const JsonValue& entry, const ReadTriangle& read);

}  // namespace armcal
