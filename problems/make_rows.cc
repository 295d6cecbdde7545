#include "problems/make_rows.h"

#include <algorithm>

#include "problems/differential_rows.h"
#include "problems/integral_rows.h"
#include "problems/weak_rows.h"

namespace armcal {

// What a block of a log must have beyond its core, so that rows at the seam are
// made of the same samples as if the log were whole.
double RowReach(const RowOptions& options) {
  switch (options.identification) {
    case Identification::kWeak:
      return options.window_s;
    case Identification::kDifferential:
      return options.bandwidth_hz > 0 ? DifferentialReach(options) : 0;
    case Identification::kIntegral:
      break;
  }
  double reach = options.intervals.empty() ? options.interval_s : 0;
  for (const TimeRange& interval : options.intervals) {
    reach = std::max(reach, interval.end - interval.begin);
  }
  return reach;
}

std::unique_ptr<IdentificationRows> MakeRows(const Trajectory& trajectory,
                                             const RowOptions& options,
                                             const MotionRegressor& regressor) {
  switch (options.identification) {
    case Identification::kWeak:
      return std::make_unique<WeakRows>(trajectory, options, regressor);
    case Identification::kDifferential:
      return std::make_unique<DifferentialRows>(trajectory, options, regressor);
    case Identification::kIntegral:
      break;
  }
  return std::make_unique<IntegralRows>(trajectory, options, regressor);
}

void ForEachRow(const Trajectory& trajectory, const RowOptions& options,
                MotionRegressor* regressor, const RowSink& sink) {
  regressor->Enter(trajectory);
  ForEachRow(*MakeRows(trajectory, options, *regressor), *regressor, sink);
}

}  // namespace armcal
