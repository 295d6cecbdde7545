#pragma once

#include <functional>
#include <vector>

#include "calib/block_triangular_factor.h"
#include "calib/leaf_factor.h"
#include "calib/ordered_work.h"
#include "problems/identification_rows.h"

namespace armcal {

// Rows to reduce as one leaf: as many as threads can share a stretch of motion
// by. Evaluating a weak row takes many samples, and reducing it next to
// nothing.
long RowsPerLeaf(const RowOptions& options);

// Adds rows to triangular factors, on all threads: each evaluates leaves' rows
// where they are reduced. The factor is the same bits for any number of
// threads.
class RowReduction {
 public:
  explicit RowReduction(const ModelParameters& parameters);

  // One equation of every joint for each row; weight 1.
  void Add(const IdentificationRows& rows, BlockTriangularFactor* factor);

 private:
  struct Slot {
    std::vector<LeafFactor> leaves;  // per joint
    RowScratch scratch;
    long begin = 0, end = 0;  // rows
  };
  static void Reduce(const IdentificationRows& rows, Slot* slot);

  OrderedWork work_;
  std::vector<Slot> slots_;
};

// Calls `sink` for the rows, some at a time and in order but not in this
// thread, while others evaluate the next. It may move the batch away.
void ForEachBatchOnThreads(const IdentificationRows& rows,
                           const MotionFunctions& functions,
                           const std::function<void(RowBatch*)>& sink);
// The same for every row.
void ForEachRowOnThreads(const IdentificationRows& rows,
                         const MotionFunctions& functions, const RowSink& sink);

}  // namespace armcal
