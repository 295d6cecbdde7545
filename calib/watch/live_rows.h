#pragma once

#include <functional>
#include <memory>
#include <string>

#include "calib/watch/live_text.h"
#include "model/log_files/columns/log_columns.h"
#include "model/log_files/log_reader_options.h"
#include "model/log_files/log_row.h"
#include "model/text/decimal_time.h"

namespace armcal {

// A sample of a log, as it comes.
struct LiveRow {
  double t = 0;  // s since the first row
  Eigen::VectorXd q, tau;
};

// The rows of a CSV that is still being written. Names and units of columns are
// those of finished logs (log_reader.h). Rows that cannot be used are skipped,
// each with a sentence to `on_bad`; a thousand of them in a row are refused.
class LiveRows {
 public:
  using BadRow = std::function<void(const std::string& why)>;
  // Reads nothing yet.
  LiveRows(const std::string& path, bool follow, double idle_s,
           const LogReaderOptions& options, BadRow on_bad);

  LiveText::Got Next(LiveRow* row);
  long skipped() const { return skipped_; }
  bool waiting() const { return text_.waiting(); }
  const std::string& torque_source() const { return torque_source_; }

 private:
  struct Columns;  // once the header has come
  void ReadHeader(std::string_view line);
  bool Parse(std::string_view line, LiveRow* row);
  void Skip(const std::string& why);

  std::string name_;
  LiveText text_;
  LogReaderOptions options_;
  BadRow on_bad_;
  std::string torque_source_;
  std::shared_ptr<Columns> columns_;
  bool started_ = false;
  DecimalTime first_, last_;
  long skipped_ = 0, skipped_together_ = 0;
};

}  // namespace armcal
