#pragma once

#include <functional>
#include <vector>

#include "calib/numerics/block_triangular_factor.h"
#include "calib/numerics/leaf_factor.h"
#include "calib/numerics/ordered_work.h"
#include "problems/identification_rows.h"

namespace armcal {

// Rows to reduce as one leaf: as many as threads can share a stretch of motion
// by. Evaluating a weak row takes many samples, and reducing it next to
// nothing.
long RowsPerLeaf(const RowOptions& options);

// A stretch of rows while it is reduced. Its columns are those that
// IdentificationRows::Evaluate writes, and may be changed.
struct ReducedRows {
  int slot;  // that it has to itself until it is finished, of num_slots()
  long count;
  double* const* columns;
  long stride;
};

// Adds rows to triangular factors, on all threads: each evaluates leaves' rows
// where they are reduced. The factor is the same bits for any number of
// threads.
class RowReduction {
 public:
  explicit RowReduction(const ModelParameters& parameters);
  // `columns`: of each joint's equation, the right side left out.
  explicit RowReduction(const std::vector<int>& columns);

  int num_slots() const { return work_.num_slots(); }
  // One equation of every joint for each row; weight 1.
  void Add(const IdentificationRows& rows, BlockTriangularFactor* factor);
  // The same to a factor per joint. change(stretch) sees every stretch in the
  // thread that has evaluated it, finish(slot) is called in the order of rows.
  void Add(const IdentificationRows& rows,
           std::vector<TriangularFactor>* factors,
           const std::function<void(const ReducedRows&)>& change,
           const std::function<void(int slot)>& finish);

 private:
  struct Slot {
    std::vector<LeafFactor> leaves;  // per joint
    RowScratch scratch;
    long begin = 0, end = 0;  // rows
  };
  // take(leaves) and put(leaves): of the factors, whose leaves have so many
  // rows.
  template <class Take, class Put, class Change>
  void Run(const IdentificationRows& rows, long leaf_rows, const Take& take,
           const Put& put, const Change& change);

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
