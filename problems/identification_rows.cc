#include "problems/identification_rows.h"

#include <algorithm>

namespace armcal {

void RowBatch::Evaluate(const IdentificationRows& rows,
                        const MotionFunctions& functions, RowScratch* scratch) {
  columns.Resize(RowSizes(functions, 1), count);
  rows.Evaluate(begin, count, columns.data(), columns.stride(), scratch);
}

// Spreads each row over all parameters, with zeros for those that do not act on
// the joint (U is block upper triangular, docs/theory.md, 1). It serves those
// who want one equation at a time; passes over logs read the columns
// themselves.
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

}  // namespace armcal
