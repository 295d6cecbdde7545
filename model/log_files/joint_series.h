#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/log_files/columns/log_signal.h"

namespace armcal {

// Signals of some of the robot's joints, or those of a force-torque sensor, as
// messages of one topic gave them.
struct JointSeries {
  struct Channel {
    std::optional<Signal> signal;  // none: of a force-torque sensor
    // 0-based: the joint, base to tip; of a sensor which of kWrenchNames.
    int index;
  };

  std::string topic;
  bool chosen = false;      // for this signal, before what others say of it
  bool has_stamps = false;  // else its times are those of reception
  std::vector<Channel> channels;
  std::vector<std::int64_t> times, received;  // ns
  std::vector<double> values;                 // NaN: not given; by time

  int size() const { return static_cast<int>(times.size()); }
  double value(long k, size_t channel) const {
    return values[k * channels.size() + channel];
  }
};

// Leaves out channels that never have a value.
void DropEmptyChannels(JointSeries* series);

// Values of all channels of a series at `time`, of its own clock: those of a
// message of this time, else on the line between the messages before and after.
// False before the first, after the last and where those two are further apart
// than three mean steps.
class JointSeriesAt {
 public:
  // Throws InputError where the times of the series do not rise.
  JointSeriesAt(const std::string& path, const JointSeries& series);

  const JointSeries& series() const { return series_; }
  bool Find(std::int64_t time);
  double value(size_t channel) const;

 private:
  const JointSeries& series_;
  double longest_step_ = 0;
  long before_ = 0;
  double share_ = 0;  // of the message after
};

}  // namespace armcal
