#pragma once

#include <vector>

#include "model/log_files/log.h"

namespace armcal {

// Rows [begin, end) of a log, from 0.
struct RowRange {
  long begin = 0, end = 0;

  bool Contains(long row) const { return row >= begin && row < end; }
};

// Whether one of them contains the row.
bool AnyContains(const std::vector<RowRange>& ranges, long row);

// The log without these rows; `first` is the number of its own first one. Their
// time stays: there is a hole in the stamps then.
Log WithoutRows(const Log& log, const std::vector<RowRange>& left_out,
                long first = 0);

// From row `row` of a log on, one joint's position is this much too large, rad:
// by whole turns, as of an encoder that wraps round.
struct PositionTurn {
  long row = 0;
  int joint = 0;
  double size = 0;
  bool of_command = false;  // the commanded position (Log::qref), not q
};

// Takes these turns out of rows that follow each other, of which the first is
// row `first` of its log.
void TakeTurns(const std::vector<PositionTurn>& turns, long first, Log* log);

// Which rows of the whole log these are that were counted without the rows left
// out of it.
RowRange CountedInAll(const RowRange& rows,
                      const std::vector<RowRange>& left_out);

}  // namespace armcal
