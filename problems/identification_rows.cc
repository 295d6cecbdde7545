#include "problems/identification_rows.h"

#include <algorithm>

#include "problems/differential_rows.h"
#include "problems/integral_rows.h"
#include "problems/weak_rows.h"

namespace armcal {

double RowReach(const RowOptions& options) {
  switch (options.identification) {
    case Identification::kWeak:
      return options.window_s;
    case Identification::kDifferential:
      return options.bandwidth_hz > 0 ? DifferentialReach(options) : 0;
    case Identification::kIntegral:
      break;
  }
  double reach = options.intervals.empty() ? options.interval_s : 0;
  for (const TimeRange& interval : options.intervals) {
    reach = std::max(reach, interval.end - interval.begin);
  }
  return reach;
}

std::unique_ptr<IdentificationRows> MakeRows(const Trajectory& trajectory,
                                             const RowOptions& options,
                                             const MotionRegressor& regressor) {
  switch (options.identification) {
    case Identification::kWeak:
      return std::make_unique<WeakRows>(trajectory, options, regressor);
    case Identification::kDifferential:
      return std::make_unique<DifferentialRows>(trajectory, options, regressor);
    case Identification::kIntegral:
      break;
  }
  return std::make_unique<IntegralRows>(trajectory, options, regressor);
}

void RowBatch::Evaluate(const IdentificationRows& rows,
                        const MotionFunctions& functions, RowScratch* scratch) {
  columns.Resize(RowSizes(functions, 1), count);
  rows.Evaluate(begin, count, columns.data(), columns.stride(), scratch);
}

void RowBatch::ForEachRow(const IdentificationRows& rows,
                          const MotionFunctions& functions,
                          IdentificationRow* row, const RowSink& sink) const {
  const auto& used = functions.row_columns();
  const int n = static_cast<int>(used.size());
  row->U.setZero(n, functions.size());
  row->Y.resize(n);
  for (long r = 0; r < count; ++r) {
    row->time = rows.time(begin + r);
    for (int i = 0; i < n; ++i) {
      const int size = static_cast<int>(used[i].size());
      for (int c = 0; c < size; ++c) {
        row->U(i, used[i][c]) = columns.column(i, c)[r];
      }
      row->Y[i] = columns.column(i, size)[r];
    }
    sink(*row);
  }
}

void ForEachRow(const IdentificationRows& rows,
                const MotionFunctions& functions, const RowSink& sink) {
  constexpr long kBatch = 64;
  RowBatch batch;
  RowScratch scratch;
  IdentificationRow row;
  for (long begin = 0; begin < rows.size(); begin += kBatch) {
    batch.begin = begin;
    batch.count = std::min(kBatch, rows.size() - begin);
    batch.Evaluate(rows, functions, &scratch);
    batch.ForEachRow(rows, functions, &row, sink);
  }
}

void ForEachRow(const Trajectory& trajectory, const RowOptions& options,
                MotionRegressor* regressor, const RowSink& sink) {
  regressor->Enter(trajectory);
  ForEachRow(*MakeRows(trajectory, options, *regressor), *regressor, sink);
}

}  // namespace armcal
