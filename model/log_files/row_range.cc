#include "model/log_files/row_range.h"

#include <algorithm>

namespace armcal {

bool AnyContains(const std::vector<RowRange>& ranges, long row) {
  return std::any_of(
      ranges.begin(), ranges.end(),
      [row](const RowRange& range) { return range.Contains(row); });
}

Log WithoutRows(const Log& log, const std::vector<RowRange>& left_out,
                long first) {
  std::vector<int> rows;
  for (int k = 0; k < log.size(); ++k) {
    if (!AnyContains(left_out, first + k)) rows.push_back(k);
  }
  Log kept = log;
  kept.t = log.t(rows).eval();
  for (Eigen::MatrixXd Log::*signal :
       {&Log::q, &Log::qd, &Log::qdd, &Log::tau, &Log::qref, &Log::temperature,
        &Log::wrench, &Log::current}) {
    if ((log.*signal).size() > 0) {
      kept.*signal = (log.*signal)(rows, Eigen::all).eval();
    }
  }
  return kept;
}

void TakeTurns(const std::vector<PositionTurn>& turns, long first, Log* log) {
  for (const PositionTurn& turn : turns) {
    Eigen::MatrixXd& x = turn.of_command ? log->qref : log->q;
    const long begin = std::max(0L, turn.row - first);
    if (begin >= x.rows()) continue;
    x.col(turn.joint).tail(x.rows() - begin).array() -= turn.size;
  }
}

// Row by row, since ranges of several joints may overlap and touch.
RowRange CountedInAll(const RowRange& rows,
                      const std::vector<RowRange>& left_out) {
  RowRange all;
  long kept = 0;
  for (long row = 0; kept < rows.end; ++row) {
    if (AnyContains(left_out, row)) continue;
    if (kept == rows.begin) all.begin = row;
    ++kept;
    all.end = row + 1;
  }
  return all;
}

}  // namespace armcal
