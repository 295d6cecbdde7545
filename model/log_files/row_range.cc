#include "model/log_files/row_range.h"

#include <algorithm>

namespace armcal {

Log WithoutRows(const Log& log, const std::vector<RowRange>& left_out,
                long first) {
  std::vector<int> rows;
  for (int k = 0; k < log.size(); ++k) {
    const auto has_it = [&](const RowRange& range) {
      return range.Contains(first + k);
    };
    if (std::none_of(left_out.begin(), left_out.end(), has_it)) {
      rows.push_back(k);
    }
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

}  // namespace armcal
