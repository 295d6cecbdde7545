#pragma once

#include <memory>
#include <optional>
#include <string>

#include "model/log_files/log_reader.h"
#include "model/text/kept_items.h"

namespace armcal {

// A log that is gone through several times. Where it fits a memory budget it is
// kept as the first pass has read it, a contiguous column per channel and
// block, and its file is not read again; where it does not, every pass reads
// the file anew, block by block.
class KeptLog {
 public:
  // A null budget keeps nothing. Throws InputError.
  KeptLog(const LogSource& source, const LogReaderOptions& options,
          std::shared_ptr<MemoryBudget> budget = nullptr);

  const LogSource& source() const { return source_; }
  const LogReaderOptions& options() const { return options_; }
  const std::string& torque_source() const { return torque_source_; }
  double torque_constants_stddev() const { return torque_constants_stddev_; }
  bool has_wrench() const { return has_wrench_; }
  bool has_current() const { return has_current_; }

  // The next rows, which live until the next call; null at the end. Throws
  // InputError.
  const Log* Next();
  // Starts again at the first row.
  void Rewind();

 private:
  LogSource source_;
  LogReaderOptions options_;
  std::string torque_source_;
  double torque_constants_stddev_ = 0;
  bool has_wrench_ = false, has_current_ = false;
  std::optional<LogReader> reader_;  // while the file is open
  Log block_;                        // of a log that is not kept
  KeptItems<Log> blocks_;
  std::size_t next_ = 0;  // of blocks_
};

}  // namespace armcal
