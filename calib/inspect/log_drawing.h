#pragma once

#include <optional>

#include "calib/numerics/series_envelope.h"
#include "model/log_files/log.h"

namespace armcal {

// What a log holds, for drawing: n signals each over its own time, from its
// first row on. A step of more than three mean ones is a gap.
struct LogDrawing {
  // rad or m; where commands are logged, of 3 n signals: positions, commands,
  // positions minus commands.
  std::optional<SeriesEnvelope> position;
  // Nothing: not logged.
  std::optional<SeriesEnvelope> velocity;  // rad/s or m/s
  std::optional<SeriesEnvelope> torque;    // N m or N, as it is read
  bool commanded = false;
};

LogDrawing DrawLog(const Log& log, int most_bins);

}  // namespace armcal
