#pragma once

#include <string>
#include <vector>

#include "model/log_files/kept_log.h"
#include "model/log_files/time_range.h"

namespace armcal {

// How far a stamp is from where it would be if samples were taken evenly, means
// over a second, s. Of a clock that runs unevenly, or of a sampler that does.
struct StampError {
  double stamp;
  double error;
};

// What the time stamps of a log are like.
struct TimeBase {
  long samples = 0;     // within the crop, duplicates not counted
  long duplicates = 0;  // rows whose time equals the row before
  TimeRange range;
  double median_step = 0;  // s
  double min_step = 0;
  double max_step = 0;
  // The mean step outside gaps (steps over three medians): what the log is
  // resampled to.
  double dt = 0;
  bool uniform = false;  // all steps equal dt: no resampling needed
  std::vector<TimeRange> gaps;
  // Empty where stamps are even. Lost samples are counted.
  std::vector<StampError> stamp_errors;
  // rms velocity over rms position of the joint that changes fastest, over
  // 2 pi: about where the motion's spectrum lies, Hz. 0 if nothing moves.
  double motion_hz = 0;

  // "3692 samples in 39.4 s, 93.6 Hz, steps 10.0-12.1 ms (resampled), ..."
  std::string Describe() const;
};

// One pass over the log, which it leaves rewound. Throws InputError where
// fewer than 3 samples with different times are in `crop`.
TimeBase AuditTimeBase(const TimeRange& crop, KeptLog* log);

}  // namespace armcal
