#include "calib/logs/recorded_logs.h"

namespace armcal {

KeptLog* RecordedLogs::Rows(int log, bool rates) {
  LogReaderOptions options = rows[log].options();
  if (rates && !options.want_velocity) {
    options.want_velocity = options.want_acceleration = true;
    rows[log] = KeptLog(rows[log].source(), options, memory);
  }
  rows[log].Rewind();
  return &rows[log];
}

}  // namespace armcal
