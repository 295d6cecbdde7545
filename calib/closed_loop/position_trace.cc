#include "calib/closed_loop/position_trace.h"

#include "problems/make_rows.h"

namespace armcal {

// Simulated minus commanded is measured minus commanded less the residual,
// measured minus simulated.
std::vector<PositionTrace> TracePositions(const LoopWindows& windows,
                                          const std::vector<LoopRun>& runs,
                                          int most_bins) {
  std::vector<PositionTrace> traces;
  const CommandedLog* last = nullptr;
  windows.ForEachRow([&](const CommandedLog& log, long row, size_t window,
                         long row_of_window, bool counts) {
    const long n = log.log.q.cols();
    const auto models = static_cast<long>(runs.size());
    if (&log != last) {
      traces.push_back(
          {log.path,
           SeriesEnvelope(static_cast<int>(n * (1 + 2 * models)), most_bins)});
    }
    last = &log;
    if (!counts) {
      traces.back().follows.Break();
      return;
    }
    Eigen::VectorXd all(n * (1 + 2 * models));
    all.head(n) = log.log.q.row(row) - log.log.qref.row(row);
    for (long m = 0; m < models; ++m) {
      const auto residual =
          runs[m].residuals[window].segment(n * row_of_window, n);
      all.segment(n * (1 + m), n) = all.head(n) - residual;
      all.segment(n * (1 + models + m), n) = residual;
    }
    traces.back().follows.Add(log.log.t[row], all);
  });
  return traces;
}

}  // namespace armcal
