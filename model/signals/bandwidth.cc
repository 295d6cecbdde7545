#include "model/signals/bandwidth.h"

#include <algorithm>

namespace armcal {

double DefaultBandwidth(const std::vector<TimeBase>& time_bases) {
  double wish = 8, limit = 20;
  for (const TimeBase& base : time_bases) {
    wish = std::max(wish, 10 * base.motion_hz);
    limit = std::min(limit, 0.2 / base.dt);
  }
  return std::min(wish, limit);
}

double DiagnosisBandwidth(const std::vector<TimeBase>& time_bases) {
  constexpr double kLeast = 10, kShareOfRate = .125;
  double hz = std::max(kLeast, DefaultBandwidth(time_bases));
  for (const TimeBase& base : time_bases) {
    hz = std::min(hz, kShareOfRate / base.dt);
  }
  return hz;
}

}  // namespace armcal
