#pragma once

#include <vector>

#include "model/log_files/log.h"

namespace armcal {

// Rows [begin, end) of a log, from 0.
struct RowRange {
  long begin = 0, end = 0;

  bool Contains(long row) const { return row >= begin && row < end; }
};

// The log without these rows; `first` is the number of its own first one. Their
// time stays: there is a hole in the stamps then.
Log WithoutRows(const Log& log, const std::vector<RowRange>& left_out,
                long first = 0);

}  // namespace armcal
