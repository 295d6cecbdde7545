#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "model/log_files/kept_log.h"
#include "model/log_files/time_base.h"
#include "model/text/memory_budget.h"

namespace armcal {

struct EncoderNoise;      // encoder_noise.h
struct KeptTrajectories;  // prepared_logs.cc

// What copies of a LogSet share. Only `rows`, `last` and `encoder_noise`
// change, under `pass`: they hold what could be read or made again.
struct RecordedLogs {
  // A log's rows from the first; with recorded rates, if they are wanted.
  KeptLog* Rows(int log, bool rates);

  std::shared_ptr<MemoryBudget> memory;
  TimeRange crop;
  std::vector<std::string> names;
  std::vector<TimeBase> time_bases;
  std::string torque_source;
  double torque_constants_stddev = 0;
  bool has_wrench = false, has_current = false;  // any of them
  std::vector<std::shared_ptr<const ReconstructedTorque>> reconstructed;

  std::mutex pass;
  std::vector<KeptLog> rows;
  std::shared_ptr<KeptTrajectories> last;  // of the last preparation
  std::map<double, std::shared_ptr<const EncoderNoise>> encoder_noise;  // by Hz
};

}  // namespace armcal
