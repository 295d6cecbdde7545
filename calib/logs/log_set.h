#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "model/log_files/log_reader.h"
#include "model/log_files/log_source.h"
#include "model/log_files/time_base.h"
#include "model/text/memory_budget.h"
#include "model/text/progress.h"

namespace armcal {

struct EncoderNoise;  // encoder_noise.h
struct RecordedLogs;  // recorded_logs.h

// Several recorded logs that are worked through together: a value that nothing
// changes, whose copies share what has been read. Passes go over a preparation
// of them (prepared_logs.h). What a pass has read is kept for the next as far
// as the memory allowed for goes; beyond it passes read again, in memory that
// does not grow with the logs, with the same results.
class LogSet {
 public:
  // Opens the logs and audits their time bases. Throws InputError.
  LogSet(const std::vector<LogSource>& sources,
         const LogReaderOptions& log_options, const TimeRange& crop,
         std::size_t memory_bytes = MemoryBudget::DefaultBytes());

  // Only these stretches of each log, s since its first row, each without its
  // end; what lies around them still feeds filters. Empty: all.
  using Stretches = std::vector<std::vector<TimeRange>>;
  LogSet Within(Stretches stretches) const;
  const Stretches& stretches() const { return stretches_; }

  int size() const;
  // Its path, or the name of one in memory.
  const std::string& path(int log) const;
  const std::vector<TimeBase>& time_bases() const;
  const std::string& torque_source() const;
  // Relative standard deviation of each joint's torque scale, one factor in all
  // logs of the robot: the largest of the logs'.
  double torque_constants_stddev() const;
  // Whether any log has a force-torque sensor's columns, which were wanted.
  bool has_wrench() const;
  // Whether any has motor currents beside the torques of joint sensors, which
  // were wanted.
  bool has_current() const;
  // What a log has instead of recorded torques; null where it has these.
  const ReconstructedTorque* reconstructed_torque(int log) const;
  // What passes may keep what they made in.
  const std::shared_ptr<MemoryBudget>& memory() const;

 private:
  friend class PreparedLogs;
  friend EncoderNoise MeasureEncoderNoise(const LogSet& logs,
                                          double bandwidth_hz);

  std::shared_ptr<RecordedLogs> recorded_;
  Stretches stretches_;
};

}  // namespace armcal
