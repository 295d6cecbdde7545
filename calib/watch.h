#pragma once

#include <functional>
#include <optional>
#include <string>

#include "calib/summary.h"
#include "calib/watch/event.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_source.h"
#include "model/robot/robot.h"

namespace armcal {

struct WatchOptions {
  std::string calibration;   // calibration.json, or its folder
  LogReaderOptions reading;  // joint_names are the robot's
  // The log is still being written: wait for more, until none has come for
  // idle_s seconds (0: for ever). A log named "-" is standard input.
  bool follow = false;
  double idle_s = 10;
  std::optional<double> bandwidth_hz;  // not given: 20, less of slow logs
  double learn_s = 30;
  double memory_s = 120;
  double false_alarms_per_hour = .1;
  std::function<void(const WatchEvent&)> on_event;  // as they are told
  // What there is to see, about `states_per_second` times a second, and
  // whenever nothing comes.
  std::function<void(const WatchState&)> on_state;
  double states_per_second = 10;
  std::function<bool()> stop;  // asked all the while; true ends it
};

// Follows a log of a calibrated robot, finished or still being written, and
// tells when payload, friction or contact changes. The summary is of all of it;
// positive where nothing was told. Throws InputError and OptionError.
Summary Watch(const Robot& robot, const LogSource& log,
              const WatchOptions& options);

}  // namespace armcal
