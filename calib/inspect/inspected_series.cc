#include "calib/inspect/inspected_series.h"

#include <algorithm>

namespace armcal {

UniformSeries InspectedSeries(const Log& log, double mean_step) {
  constexpr double kBandwidth = 8;  // Hz, of what torques are compared with
  const double dt = std::max(mean_step, .002);
  const double hz = std::min(kBandwidth, .2 / dt);
  return {log, dt, std::max(.25 / hz, 3 * dt), hz};
}

}  // namespace armcal
