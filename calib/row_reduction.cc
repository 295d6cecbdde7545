#include "calib/row_reduction.h"

#include <algorithm>

namespace armcal {

long RowsPerLeaf(const RowOptions& options) {
  return options.identification == Identification::kDifferential
             ? TriangularFactor::kLeafRows
             : 64;
}

RowReduction::RowReduction(const ModelParameters& parameters)
    : slots_(work_.num_slots()) {
  for (Slot& slot : slots_) {
    for (int i = 0; i < parameters.num_joints(); ++i) {
      slot.leaves.emplace_back(
          static_cast<int>(parameters.row_columns(i).size()));
    }
  }
}

void RowReduction::Add(const IdentificationRows& rows,
                       BlockTriangularFactor* factor) {
  long next = 0;
  const auto prepare = [&](int k) {
    if (next == rows.size()) return false;
    Slot& slot = slots_[k];
    long under_way = 0;
    if (next == 0) {
      factor->TakeLeaves(&slot.leaves);
      under_way = slot.leaves[0].rows();
    }
    slot.begin = next;
    next = std::min(rows.size(), next + factor->leaf_rows() - under_way);
    slot.end = next;
    return true;
  };
  work_.Run(
      prepare, [&](int k) { Reduce(rows, &slots_[k]); },
      [&](int k) { factor->PutLeaves(&slots_[k].leaves); });
}

void RowReduction::Reduce(const IdentificationRows& rows, Slot* slot) {
  std::vector<double*> out(slot->leaves.size());
  for (long row = slot->begin; row < slot->end;) {
    const long count = std::min(slot->leaves[0].room(), slot->end - row);
    for (size_t i = 0; i < out.size(); ++i) out[i] = slot->leaves[i].Next();
    rows.Evaluate(row, count, out.data(), LeafFactor::kStride, &slot->scratch);
    for (LeafFactor& leaf : slot->leaves) leaf.Commit(count);
    row += count;
  }
}

void ForEachBatchOnThreads(const IdentificationRows& rows,
                           const MotionFunctions& functions,
                           const std::function<void(RowBatch*)>& sink) {
  constexpr long kBatch = 32;
  struct Slot {
    RowBatch batch;
    RowScratch scratch;
  };
  const OrderedWork work;
  std::vector<Slot> slots(work.num_slots());
  long next = 0;
  const auto prepare = [&](int k) {
    if (next == rows.size()) return false;
    slots[k].batch.begin = next;
    slots[k].batch.count = std::min(kBatch, rows.size() - next);
    next += slots[k].batch.count;
    return true;
  };
  work.Run(
      prepare,
      [&](int k) {
        slots[k].batch.Evaluate(rows, functions, &slots[k].scratch);
      },
      [&](int k) { sink(&slots[k].batch); });
}

void ForEachRowOnThreads(const IdentificationRows& rows,
                         const MotionFunctions& functions,
                         const RowSink& sink) {
  IdentificationRow row;
  ForEachBatchOnThreads(rows, functions, [&](const RowBatch* batch) {
    batch->ForEachRow(rows, functions, &row, sink);
  });
}

}  // namespace armcal
